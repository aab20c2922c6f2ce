"""The kinds of warnings on a case and on its decision, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class AssessmentKind(Kind):
    """A kind of warning on a case and on its decision."""

    # fmt: off
    # What one degree of freedom does not follow.
    CONTACTS_OPEN = auto(), "contacts open"
    IMPACT_OPENS = auto(), """an impact that keeps less than 0.3 of the velocity may open
        contacts""", "impact may open"
    COURSES_THROWN = auto(), "courses above a rocking body may be thrown", "courses may be thrown"
    NOT_FOLLOWED = auto(), "the mechanism of least λ cannot be followed", "weakest not followed"

    # What else makes a decision doubtful: in the order in which a decision lists its warnings.
    COMPONENT_MISSING = auto(), "a component gave no result"
    OTHER_CRACK_WORSE = auto(), "a crack other than the known one is worse", "another crack is worse"
    NO_STACK = auto(), """contact dynamics cannot follow it, because it is neither a stack of courses nor a
        chain of stones""", "no stack or stones"
    MEMBERS_FAILED = auto(), "members could not be followed", "some members failed"
    HELD_BEYOND = auto(), """a held wall rotates so far that its mechanism may predict too
        little""", "rotates far"
    TIES_GIVE = auto(), """its ties stretch, and under the motion that they transmit the wall between them
        rotates far""", "its ties give"
    FRICTION_SHORT = auto(), "a contact needs more friction than it has while it rocks", "a contact slides"
    STONES_TELL = auto(), """an arch on piers may fall as voussoirs where its mechanism
        stands""", "not followed as voussoirs"
    ANCHOR_GIVES = auto(), """the course that the anchor of a tie grips slides out before the wall moves as it
        is followed""", "an anchor slides out"
    SLIDES_FIRST = auto(), "a crack that slides before it lifts is left out", "a crack slides first"

    # What would tell more of a decision.
    TIE_STRENGTH = auto(), "give the strength at which its ties fail", "give the ties' strength"
    FRICTION = auto(), """measure the friction of its joints, and give it
        (friction_coefficient)""", "measure friction"
    ANCHORS = auto(), """let each anchor grip more of the wall, and say how much
        (anchor_height_m, anchor_width_m)""", "larger anchors"
    INPUT = auto(), "give a record and settings under which it can be followed", "not followed"
    ENSEMBLE = auto(), "follow an ensemble of members (ensemble: members)", "follow an ensemble"
    TOLERANCE = auto(), "give a restitution below 1, or another tolerance", "give restitution below 1"
    CRACK = auto(), "find out where it cracks, and state it (crack: known)", "find where it cracks"
    RESTITUTION = auto(), """measure the restitution, or take it from tests of such
        masonry""", "measure its restitution"
    PROCESSING = auto(), """use a processed record of the network instead of the raw
        one""", "use a processed record"
    CONTACT_DYNAMICS = auto(), """follow it by 64 runs of contact dynamics (fidelity:
        contact)""", "contact dynamics"
    COMPONENT = auto(), "find the component that gave no result", "find missing component"

    # What explains a decision of which nothing more would tell.
    OTHER_PERIODS = auto(), "at other periods {share} overturn", "at other T_b {share} fall"
    CONTACT_SLIDES = auto(), """a contact needs a friction of {lifting:.2g} as it lifts and up to
        {largest:.2g} as it rocks""", "slides below μ {lifting:.2g}–{largest:.2g}"
    FALLS_AS_RECORDED = auto(), "as recorded it falls", "as recorded: falls"
    STANDS_AS_RECORDED = auto(), "as recorded it stands", "as recorded: stands"
    STACKS_FALL = auto(), """in contact dynamics {falls} of {runs} runs
        fall""", "contact dynamics: {falls} of {runs} fall"
    MECHANISM_FALLS = auto(), "as a mechanism {members} fall", "as a mechanism: {members} fall"
    STRENGTHEN = auto(), "strengthen or tie it", "strengthen"
    SEATS = auto(), """lengthen or tie the bearings of what lies on it: some lose them
        (support_loss_m)""", "bearings lost"
    FLOORS_MOVE = auto(), """it moves up to {moved_m:.2g} m below what lies on it: compare its bearings
        (support_loss_m)""", "moves {moved_m:.2g} m below floors"
    TIE_THE_TOP = auto(), "tie its top, or say by top_friction what holds it", "tie its top"
    NOTHING_DECIDES = auto(), "no input decides on its own", "no input decides"
    NOTHING_TO_DO = auto(), "nothing needs to be done", "nothing"

    # A structure, and where it stands.
    HELD_AT_CEILING = auto(), """{about}: taken as held at floor and ceiling; a wall that is free at its top,
        such as a boundary wall, is a free_wall."""
    ON_STILL_BASE = auto(), """{about}: with a base that rocks it may fall where alone it stands, as 4 of 123
        bodies on a pedestal did."""
    VERTICAL_MISSING = auto(), """The settings ask for the vertical component (vertical: true), but there is
        none, and none acts."""
    # fmt: on
