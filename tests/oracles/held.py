"""A façade that opens at a foot, a hinge and a hold: where every mass is, from rectangles turned one by one."""

from itertools import pairwise

from lagrangian import Lagrangian, turned
from mpmath import findroot, mp, mpf

from rocking.quantities import GRAVITY


def opened_lagrangian(facade, opening):
    """Positions in the façade's own coordinates as it falls outwards; x = 0 is its outer face."""
    sign = 1 if opening.forwards else -1
    levels = [mpf(0)]
    for height in facade.storey_heights:
        levels.append(levels[-1] + mpf(height))
    foot, hinge_height, hold = mpf(opening.foot), mpf(opening.hinge), mpf(opening.hold)

    def thickness_at(z):
        """Of the thinner storey that ends at the joint."""
        meets = [
            t
            for t, low, high in zip(facade.thicknesses, levels, levels[1:], strict=False)
            if low <= z <= high
        ]
        return mpf(min(meets))

    def edge(z, outer):
        return (mpf(0) if outer else -thickness_at(z)), z

    base = edge(foot, sign > 0)
    hinge = edge(hinge_height, sign < 0)
    held = edge(hold, sign > 0) if opening.upright else (mpf(0), hold)

    def lower(phi, point):
        return turned(point, base, sign * phi)

    def upper_angle(phi):
        at = lower(phi, hinge)

        def off(angle):
            dx, dz = held[0] - hinge[0], held[1] - hinge[1]
            return at[0] + mp.cos(angle) * dx + mp.sin(angle) * dz - held[0]

        ratio = (hinge_height - foot) / (hold - hinge_height)
        return findroot(off, -sign * phi * ratio, tol=1e-50)

    def where(phi, body, x, z):
        point = mpf(x), mpf(z)
        if body == 0:
            return (*lower(phi, point), -sign * phi)
        at, angle = lower(phi, hinge), upper_angle(phi)

        def upper(point):
            moved = turned((point[0] - hinge[0] + at[0], point[1] - hinge[1] + at[1]), at, angle)
            return moved

        if body == 1:
            return (*upper(point), -angle)
        risen = upper(held)
        return point[0] + risen[0] - held[0], point[1] + risen[1] - held[1], mpf(0)

    def body_below(z):
        if z <= hinge_height:
            return 0
        return 1 if z <= hold or not opening.upright else 2

    cuts = sorted({*levels, foot, hinge_height, *([hold] if opening.upright else [])})
    rectangles = []
    for low, high in pairwise(cuts):
        if high <= foot:
            continue
        t = next(
            mpf(t) for t, a, b in zip(facade.thicknesses, levels, levels[1:], strict=False) if a <= low < b
        )
        mass = mpf(facade.unit_weight) * t * (high - low) / mpf(GRAVITY)
        rectangles.append(
            (mass, mass * (t**2 + (high - low) ** 2) / 12, -t / 2, (low + high) / 2, body_below(high))
        )
    bearings = []
    for n, load in enumerate(facade.floor_loads):
        z, t = levels[n + 1], mpf(facade.thicknesses[n])
        if z <= foot:
            continue
        x = -t / 2 - mpf(facade.eccentricity)
        if facade.top_slab == "flat" and n == len(facade.floor_loads) - 1:
            # the edge that rises: the upper body turns against the lower one
            x = -t / 2 if opening.upright else (mpf(0) if sign > 0 else -t)
        bearings.append((mpf(load) / mpf(GRAVITY), x, z, body_below(z)))

    def places(phi):
        found = []
        for mass, inertia, x, z, body in rectangles:
            found.append((mass, inertia, *where(phi, body, x, z)))
        if not facade.loads_held:
            for mass, x, z, body in bearings:
                found.append((mass, mpf(0), *where(phi, body, x, z)[:2], mpf(0)))
        return found

    def stored(phi):
        energy = mpf(0)
        if facade.loads_held:
            for mass, x, z, body in bearings:
                energy += mass * mpf(GRAVITY) * where(phi, body, x, z)[1]
        for z in facade.tie_heights:
            if foot < z < hold:
                u = where(phi, body_below(z), 0, z)[0]
                if u > 0:
                    energy += mpf(facade.tie_stiffness) * u**2 / 2
        return energy

    return Lagrangian(places, stored)
