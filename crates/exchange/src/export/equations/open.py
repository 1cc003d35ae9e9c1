def positions(u, guess=START, t=0.0):
    """Coordinates p: all are independent, so that neither guess nor time matter."""
    return np.array(u, dtype=float)


def motion(t, u, du, guess=START):
    """Coordinates, rates, accelerations and driving efforts, of which there are none."""
    p, dp = positions(u, guess, t), np.array(du, dtype=float)
    ddp = np.linalg.solve(mass(p), forces(p, dp, t) - velocity_terms(p, dp))
    return p, dp, ddp, np.zeros(0)
