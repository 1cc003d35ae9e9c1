def dot(a, b):
    """Scalar product of vectors of the plane, which are complex numbers."""
    return (np.conj(a) * b).real


def mass(p):
    """Mass matrix M [kg m^2, kg m, kg]."""
    d = slopes(p)
    return (np.conj(d).T * MASSES @ d).real + TURNS.T * INERTIAS @ TURNS


def velocity_terms(p, dp):
    """h: what masses resist at constant rates [N m, N]."""
    return (np.conj(slopes(p)).T @ (MASSES * bends(p, dp))).real
