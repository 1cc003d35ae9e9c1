def positions(u, guess=START, t=0.0):
    """Coordinates p at time t, with the independent ones u, on the branch of the guess.

    Drivers and independent coordinates go from their values in the guess to the wanted ones by
    short strides, and Newton's iteration closes the loops after each. A guess that is near saves
    strides: the last p of a motion.
    """
    p = np.array(guess, dtype=float)
    wanted = np.concatenate([drive(t)[0], np.asarray(u, dtype=float)])
    begin = GIVEN @ p
    far = np.max(np.abs(wanted - begin) / (np.abs(GIVEN) @ SCALES), initial=0.0)
    if not far <= STRIDE * MOST_STRIDES:
        raise ValueError(f"u = {u}, t = {t}: no numbers, or too far from the guess")
    strides = 1 + int(far / STRIDE)
    for stride in range(1, strides + 1):
        given = begin + (wanted - begin) * (stride / strides)
        for _ in range(MOST_STEPS):
            rows = np.vstack([jacobian(p), GIVEN])
            step = np.linalg.solve(rows, np.concatenate([-closures(p), given - GIVEN @ p]))
            p += step
            if np.max(np.abs(step) / SCALES) <= CLOSED:
                break
        else:
            raise ArithmeticError(f"u = {u}, t = {t}: the loops do not close")
    return p


def motion(t, u, du, guess=START):
    """Coordinates, rates, accelerations, driving efforts at independent coordinates and rates."""
    p = positions(u, guess, t)
    rows = np.vstack([jacobian(p), GIVEN])
    _, df, ddf = drive(t)
    free = len(INDEPENDENT)
    driven = slice(len(rows) - len(GIVEN), len(rows) - free)
    r = np.linalg.solve(rows, np.eye(len(rows))[:, len(rows) - free :])
    dp = np.linalg.solve(rows, np.concatenate([np.zeros(driven.start), df, du]))
    c = np.linalg.solve(rows, np.concatenate([gamma(p, dp), ddf, np.zeros(free)]))
    m, q = mass(p), forces(p, dp, t) - velocity_terms(p, dp)
    ddu = np.linalg.solve(r.T @ m @ r, r.T @ (q - m @ c))
    ddp = c + r @ ddu
    multipliers = np.linalg.solve(rows.T, m @ ddp - q)
    return p, dp, ddp, multipliers[driven]
