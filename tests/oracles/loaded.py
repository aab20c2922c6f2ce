"""Façades and walls with loads, thrusts and ties: where every mass is, what energy is stored, how ties stretch."""

from lagrangian import Lagrangian, turned
from mpmath import findroot, mp, mpf

from rocking.quantities import GRAVITY


def elastic(structure, stretches):
    """Energy of ties that have not yielded."""
    return sum((structure.tie_pretension * u + structure.tie_stiffness * u**2 / 2 for u in stretches), mpf(0))


def facade_lagrangian(facade, sign):
    """The façade in its own coordinates: outer face x = 0, the pivot of the side, rectangles and points."""
    crack, heights, thicknesses = (facade.crack_storey or 1) - 1, facade.storey_heights, facade.thicknesses
    pivot = (mpf(0 if sign > 0 else -thicknesses[crack]), mpf(sum(heights[:crack])))
    still = mpf(GRAVITY)

    def where(phi, x, y):
        return turned((mpf(x), mpf(y)), pivot, sign * phi)

    def places(phi):
        found, level = [], mpf(pivot[1])
        for n in range(crack, len(heights)):
            mass = facade.unit_weight * heights[n] * thicknesses[n] / still
            inertia = mass * (mpf(heights[n]) ** 2 + mpf(thicknesses[n]) ** 2) / 12
            centre = where(phi, -thicknesses[n] / 2, level + heights[n] / 2)
            found.append((mass, inertia, *centre, -sign * phi))
            level += heights[n]
            if not facade.loads_held:
                found.append((facade.floor_loads[n] / still, mpf(0), *where(phi, *bearing(n, level)), mpf(0)))
        return found

    def bearing(n, level):
        if facade.top_slab == "flat" and n == len(heights) - 1:
            return (-thicknesses[n] if sign > 0 else 0.0), level
        return -thicknesses[n] / 2 - facade.eccentricity, level

    def stored(phi):
        energy, level = mpf(0), mpf(pivot[1])
        for n in range(crack, len(heights)):
            level += heights[n]
            if facade.loads_held:
                energy += facade.floor_loads[n] * (where(phi, *bearing(n, level))[1] - level)
        thrust = facade.height if facade.thrust_height is None else facade.thrust_height
        if thrust > pivot[1]:
            energy -= facade.thrust * where(phi, 0, thrust)[0]
        return energy + elastic(facade, stretches(phi))

    def stretches(phi):
        return [where(phi, 0, z)[0] for z in facade.tie_heights if sign > 0 and z > pivot[1]]

    return Lagrangian(places, stored, stretches)


def wall_lagrangian(wall, sign):
    """Two rectangles pinned as the drawing says; the upper one's angle from its top corner staying on its line."""
    h1, h2, t = mpf(wall.lower_height), mpf(wall.upper_height), mpf(wall.thickness)
    base = (t / 2, mpf(0))

    def upper(phi):
        hinge = turned((-t / 2, h1), base, phi)
        psi = findroot(lambda a: hinge[0] + t * mp.cos(a) - h2 * mp.sin(a) - t / 2, phi * h1 / h2, tol=1e-50)
        return hinge, psi

    def on_upper(phi, x, y):
        hinge, psi = upper(phi)
        dx, dy = mpf(x) + t / 2, mpf(y) - h1
        return hinge[0] + mp.cos(psi) * dx - mp.sin(psi) * dy, hinge[1] + mp.sin(psi) * dx + mp.cos(psi) * dy

    weight, still = mpf(wall.unit_weight) * t, mpf(GRAVITY)
    bearing = t / 2 if wall.top_slab == "flat" else -sign * mpf(wall.eccentricity)

    def places(phi):
        m1, m2 = weight * h1 / still, weight * h2 / still
        lower = turned((mpf(0), h1 / 2), base, phi)
        found = [
            (m1, m1 * (h1**2 + t**2) / 12, *lower, -phi),
            (m2, m2 * (h2**2 + t**2) / 12, *on_upper(phi, 0, h1 + h2 / 2), upper(phi)[1]),
        ]
        if not wall.load_held:
            found.append((wall.top_load / still, mpf(0), mpf(0), on_upper(phi, bearing, h1 + h2)[1], mpf(0)))
        return found

    def stored(phi):
        energy = wall.top_load * on_upper(phi, bearing, h1 + h2)[1] if wall.load_held else mpf(0)
        return energy + elastic(wall, stretches(phi))

    def stretches(phi):
        def point(z):
            return turned((t / 2, mpf(z)), base, phi) if z <= h1 else on_upper(phi, t / 2, z)

        return [point(z)[0] - t / 2 for z in wall.tie_heights if sign > 0]

    return Lagrangian(places, stored, stretches)
