"""The kinds of warnings on a structure, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class StructureKind(Kind):
    """A kind of warning on a structure."""

    # fmt: off
    # What a model leaves out.
    CURVE_ALONE = auto(), "A capacity curve says nothing of impacts, sliding or opening contacts."
    FRAME_CONTACTS = auto(), """The contact forces of a frame are indeterminate: no verdict says whether its
        contacts slide as it rocks."""

    # A structure, and where it stands.
    SIZE_UNUSUAL = auto(), """{about} is {value:.6g}{unit}, but is usually between {low:g} and {high:g}{unit}
        for {type}; check the unit."""
    BROADER_THAN_TALL = auto(), """{about} is {across_m:.6g} m and {height} {height_m:.6g} m: a body this
        broad slides before it rocks; check which is which."""
    LEVELS_TYPED = auto(), """{about} is {typed} m, each about a storey more than the one before: if these are
        levels above the ground, give the height of each storey; as they stand they make {total_m:.6g} m."""
    ONE_LEAF = auto(), "Taken as one leaf of {thickness} m; give leaves_m where leaves may part."
    TIES_ALL_ALONG = auto(), """Its ties are taken to hold it all along: give their tie_spacing and the
        unit_length of the masonry, or held_between: floor where a stiff floor or a ring beam holds it between
        them."""
    RODS_SPREAD = auto(), """Rods of {diameter_mm:g} mm, {length_m:g} m long, every {spacing_m:g} m are spread
        over the metre: E A/(L s) = {stiffness_kN_m2:.4g} kN/m per m, f_y A/s = {strength_kN_m:.4g} kN/m."""
    FLOORS_BEHIND = auto(), """It rocks inwards as freely as outwards, although the floors that it carries or
        is tied to are behind it; behind: floors or cross_walls, with the restitution of its impact on them,
        prevents this. Neither is always on the safe side, so assess both."""
    RESTITUTION_TYPED = auto(), """The restitution of {typed:.2g} is typed, while the balance of momentum of
        the geometry gives {own:.2g}, with which less energy is lost: both are followed, and where their
        verdicts differ the share is a
        range.""", "{about}: restitution {typed:.2g} typed, {own:.2g} by geometry"
    RESTITUTION_ABOVE = auto(), """The restitution of {typed:.2g} is typed, above the {own:.2g} that the
        balance of momentum gives for rigid bodies of this geometry: it rocks longer than they would; check
        it, or leave it out."""

    # A crack that a survey found.
    CRACK_KNOWN = auto(), "crack known (survey)"
    CRACK_KNOWN_AT = auto(), "crack known at {height_m:.6g} m (survey)", "crack known at {height_m:.6g} m"

    # What holds a wall sideways. In motion: the largest forces of ties in 65 walls (theory: what the hold needs).
    TIE_MUST_BEAR = auto(), """The tie at {height_m:.4g} m has no strength (tie_strength) and is assumed to
        hold: when the wall {about} it carries {needed_kN_m:.3g} kN/m statically, and in motion, with the
        impacts of the wall, about 2.8 times that (1.9 to 4.8 in eight of ten walls); give its strength."""
    TIE_BEARS = auto(), """The tie at {height_m:.4g} m fails at {gives_kN_m:.3g} kN/m and carries
        {needed_kN_m:.3g} kN/m statically when the wall {about}; in motion, with the impacts of the wall, ties
        carried about 2.8 times the static force (1.9 to 4.8 in eight of ten walls)."""
    ANCHOR_SLIDES = auto(), """The tie at {height_m:.4g} m may get {most_kN_m:.3g} kN/m, but the wall around
        it gives {grip_kN_m:.3g} kN/m by friction ({friction:.2g} of what lies above it and of what the anchor
        grips, anchor_height_m and anchor_width_m): that may slide out; spread the anchor over several courses."""
    EACH_TIE = auto(), """Each tie at {height_m:.4g} m, {spacing_m:.4g} m from the next, carries
        {needed_kN:.3g} kN statically when the wall {about}; the masonry that its anchor grips gives
        {grip_kN:.3g} kN by friction."""
    TIE_YIELDS = auto(), """The tie at {height_m:.4g} m fails at {gives_kN_m:.3g} kN/m, before the wall
        {about}, for which it would have to carry {needed_kN_m:.3g} kN/m."""
    TOP_HOLDS = auto(), """The top at {height_m:.4g} m needs {needed_kN_m:.3g} kN/m statically when the wall
        {about}; friction of {friction:.2g} under what lies on it, and ties there, provide {gives_kN_m:.3g}
        kN/m. In motion, with the impacts of the wall, it needs about 2.8 times the static force (1.9 to 4.8
        in eight of ten walls)."""
    TOP_SLIPS = auto(), """The top at {height_m:.4g} m slips: when the wall {about} it needs {needed_kN_m:.3g}
        kN/m, and friction of {friction:.2g} under what lies on it, and ties there, provide {gives_kN_m:.3g}
        kN/m, so the wall is computed as one that slips there; ties of {tie_kN_m:.3g} kN/m at the top
        (tie_heights) hold it statically, and in motion it needs about 2.8 times that
        force.""", "its top slips: it needs {needed_kN_m:.3g} kN/m, friction and ties provide {gives_kN_m:.3g}"
    TOP_MUST_BE_HELD = auto(), """The top at {height_m:.4g} m is assumed to be held: when the wall {about} it
        needs {needed_kN_m:.3g} kN/m statically, and in motion, with the impacts of the wall, about 2.8 times
        that (1.9 to 4.8 in eight of ten walls)."""
    TOP_TAKEN_AS_HELD = auto(), """The top is assumed to be held: when the wall {about} it needs {share:.2g}
        of the weight of the wall statically, and about 2.8 times that in motion, but no load on it is given,
        so no friction holds it."""

    # Why something could not be computed or drawn.
    CURVE_HAS_NO_GEOMETRY = auto(), """a capacity curve has no geometry of which a static check could take
        masses and displacements; check it in the program that it comes from."""
    FALLS_AT_REST = auto(), """the structure does not stand: what acts on it at rest turns it over; correct
        its sizes, lean or loads."""
    # fmt: on
