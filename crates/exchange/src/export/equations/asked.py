def acceleration(t, u, du, guess=START):
    """Accelerations of the independent coordinates [rad/s^2, m/s^2]."""
    return motion(t, u, du, guess)[2][INDEPENDENT]


def effort(t, u=(), du=(), guess=START):
    """Torques [N m] and forces [N] that the drivers exert."""
    return motion(t, u, du, guess)[3]


def check():
    """Names, values computed here, and those that linkdyn computed at the start."""
    p, dp, ddp, efforts = motion(0.0, START[INDEPENDENT], START_RATES[INDEPENDENT])
    a, alpha = slopes(p) @ ddp + bends(p, dp), TURNS @ ddp
    rows = []
    for k, body in enumerate(BODIES):
        there = START_ACCELERATIONS[k]
        rows.append((f"{body}: a_x [m/s^2]", a[k].real, there.real))
        rows.append((f"{body}: a_y [m/s^2]", a[k].imag, there.imag))
        rows.append((f"{body}: alpha [rad/s^2]", alpha[k], START_TURNS[k]))
    for k, driver in enumerate(DRIVERS):
        rows.append((f"{driver}: effort [N m, N]", efforts[k], START_EFFORTS[k]))
    return rows


if __name__ == "__main__":
    print(f"{'at the start':<32}{'here':>24}{'linkdyn':>24}")
    for name, here, there in check():
        print(f"{name:<32}{here:>24.15g}{there:>24.15g}")
