"""Remarks: what there is to say of a file, a record, a structure or a case.

A remark is made where the fact is known: its kind, what it is about, and its values. Code compares kinds and reads
values; the words are made where a person reads them, from the one catalogue of sentences that the kinds hold. A new
remark is one line of that catalogue.
"""

from dataclasses import dataclass
from enum import StrEnum, auto
from string import Formatter

Value = str | int | float


class Kind(StrEnum):
    """Every kind of remark: its code, which tables and results hold, and its sentence.

    A sentence names its values in braces, with their format; {about} is what the remark is about. The code is the name
    in small letters.
    """

    sentence: str
    brief: str
    """The same in as few words as a line of a table has room for; the sentence where it is short itself."""
    value_names: tuple[str, ...]
    """The values that the sentence names, in order of the alphabet."""
    names_subject: bool
    """Whether it also names what the remark is about."""

    def __new__(cls, code: str, sentence: str = "", brief: str = "") -> "Kind":
        """Make a kind of its code, with the sentence beside it. Raises ValueError for one without a sentence."""
        if not sentence:
            raise ValueError(f"remark {code} has no sentence.")
        kind = str.__new__(cls, code)
        kind._value_ = code
        kind.sentence = sentence
        kind.brief = brief or sentence
        named = {name for _, name, _, _ in Formatter().parse(sentence) if name}
        kind.value_names = tuple(sorted(named - {"about"}))
        kind.names_subject = "about" in named
        return kind

    # fmt: off
    # What one degree of freedom does not follow.
    CONTACTS_OPEN = auto(), "contacts open"
    IMPACT_OPENS = auto(), "an impact that keeps less than 0.3 of the velocity may open contacts", "impact may open"
    COURSES_THROWN = auto(), "courses above a rocking body may be thrown", "courses may be thrown"

    # What else makes a decision doubtful.
    COMPONENT_MISSING = auto(), "a component gave no result"
    OTHER_CRACK_WORSE = auto(), "a crack other than the one given is worse", "another crack is worse"
    MEMBERS_FAILED = auto(), "members could not be followed", "some members failed"
    NO_STACK = auto(), (
        "contact dynamics cannot follow it, because it is not a stack of courses"
    ), "not a stack of courses"
    HELD_BEYOND = auto(), (
        "a held wall rotates so far that its mechanism may predict too little"
    ), "rotates far"
    TIES_GIVE = auto(), (
        "its ties stretch, and under the motion that they transmit the wall between them rotates far"
    ), "its ties give"
    CURVE_ALONE = auto(), (
        "a capacity curve says nothing of impacts, sliding or opening contacts"
    ), "curve alone"
    # What would tell more of a decision.
    TIE_STRENGTH = auto(), "give the strength at which its ties fail", "give the ties' strength"
    FRICTION = auto(), "measure the friction of its joints, and give it (friction_coefficient)", "measure friction"
    INPUT = auto(), "give a record and settings under which it can be followed", "not followed"
    ENSEMBLE = auto(), "follow an ensemble of members (ensemble: members)", "follow an ensemble"
    TOLERANCE = auto(), "give a restitution below 1, or another tolerance", "give restitution below 1"
    CRACK = auto(), "find out where it cracks, and state it (crack: known)", "find where it cracks"
    RESTITUTION = auto(), (
        "measure the restitution, or take it from tests of such masonry"
    ), "measure its restitution"
    PROCESSING = auto(), (
        "use a processed record of the network instead of the raw one"
    ), "use a processed record"
    CONTACT_DYNAMICS = auto(), "follow it by 64 runs of contact dynamics (fidelity: contact)", "contact dynamics"
    COMPONENT = auto(), "find the component that gave no result", "find missing component"

    # What explains a decision of which nothing more would tell.
    OTHER_PERIODS = auto(), "at other periods {share} overturn", "at other T_b {share} fall"
    CONTACT_SLIDES = auto(), (
        "a contact needs a friction of {lifting:.2g} as it lifts and up to {largest:.2g} as it rocks"
    ), "slides below μ {lifting:.2g}–{largest:.2g}"
    FALLS_AS_RECORDED = auto(), "as recorded it falls", "as recorded: falls"
    STANDS_AS_RECORDED = auto(), "as recorded it stands", "as recorded: stands"
    STACKS_FALL = auto(), "in contact dynamics {falls} of {runs} runs fall", "contact dynamics: {falls} of {runs} fall"
    STRENGTHEN = auto(), "strengthen or tie it", "strengthen"
    TIE_THE_TOP = auto(), "tie its top, or say by top_friction what holds it", "tie its top"
    NOTHING_DECIDES = auto(), "no input decides by itself", "no input decides"
    NOTHING_TO_DO = auto(), "nothing needs to be done", "nothing"

    # The samples of a record.
    STEP_UNUSUAL = auto(), (
        "The time step is {time_step_s:g} s: accelerographs sample strong motion at steps from {shortest_s:g} to "
        "{longest_s:g} s."
    )
    PEAK_IMPOSSIBLE = auto(), (
        "The peak acceleration is above 5 g, which no recorded ground motion has reached; check the unit and the "
        "factor."
    )
    PEAK_RARE = auto(), (
        "The peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded ground motion is so strong; check "
        "unit and file."
    )
    PEAK_RARE_BY_FACTOR = auto(), (
        "Multiplied by {factor:g} the peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded ground "
        "motion is so strong; check the factor."
    )
    PEAK_TINY = auto(), "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit."
    PEAK_TINY_BY_UNIT = auto(), (
        "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit; multiplied {factors} it would "
        "be plausible."
    )
    SCALED_FAR = auto(), (
        "Scaled by {factor:.3g}, beyond a factor of {largest:g}: a record that is really so strong or weak has "
        "another duration and other periods; choose another record."
    )
    SAMPLE_ALONE = auto(), (
        "The sample at {time_s:g} s is {peak_g:.3g} g and stands alone; without it the peak acceleration is "
        "{others_g:.3g} g: a number is damaged, or the instrument was struck."
    )
    ZEROS_IN_SHAKING = auto(), "Within the strong shaking {samples} samples in a row are zero: a filled gap?"
    STILL_STRETCH = auto(), (
        "From {time_s:g} s on {samples} samples in a row are the same, while those before and after change: a filled "
        "gap?"
    )
    ROW_REPEATED = auto(), (
        "At {time_s:g} s all channels repeat the sample before: a row of numbers is repeated."
    )
    HALF_REPEATED = auto(), (
        "The second half of the samples repeats the first, {samples} numbers: the file may be appended to itself."
    )
    NEVER_NEGATIVE = auto(), (
        "No number of {about} is below zero: it is a spectrum, a series of magnitudes, or a record whose offset was "
        "not removed."
    )
    NUMBER_CUT = auto(), (
        "The last number has fewer decimals than those above it and no line end: the file may be cut."
    )
    UNEVEN = auto(), (
        "The {samples} samples are unevenly spaced; interpolated linearly to {number} at their median step, "
        "{time_step_s:g} s."
    )
    UNEVEN_FILM = auto(), (
        "The {samples} samples are unevenly spaced; interpolated linearly to {number}, {time_step_s:g} s apart."
    )
    CUT_TO_THE_SHORTER = auto(), (
        "The components hold {short} and {long} samples; the longer was cut to the shorter."
    )
    STILL_RINGING = auto(), (
        "The support still rings at {share:.1%} of its peak where its motion is cut off, {after_s:.0f} s after the "
        "record."
    )

    # The header of a record against its samples.
    PEAK_UNLIKE_HEADER = auto(), (
        "The peak is {peak_m_s2:.6g} m/s², but the header states {stated_m_s2:.6g} m/s², which is more than rounding: "
        "a number or a factor is damaged."
    )
    PEAK_ELSEWHERE = auto(), (
        "The header puts the peak at {stated_s:g} s, but it occurs at {time_s:g} s: lines may be missing, repeated "
        "or out of order before it, or the time step differs."
    )
    MEAN_SQUARE_UNLIKE_HEADER = auto(), (
        "The root mean square of the samples is {value:.6g} {unit}, but the header states {stated:.6g} {unit}: numbers "
        "are damaged, missing or repeated, or a factor is wrong."
    )
    VELOCITY_UNLIKE_THERE = auto(), (
        "Around {time_s:g} s the file's own velocity is not the integral of its acceleration: numbers of one of them "
        "are damaged there."
    )
    VELOCITY_UNLIKE = auto(), (
        "The file's own velocity is not the integral of its acceleration: it is damaged."
    )
    SAMPLES_SURPLUS = auto(), (
        "The header declares {declared} samples; the file holds {held}, and all are kept."
    )
    LINE_SURPLUS = auto(), (
        "The header declares {declared} samples; the 1 surplus line repeats the end and is left out."
    )
    LINES_SURPLUS = auto(), (
        "The header declares {declared} samples; the {lines} surplus lines repeat the end and are left out."
    )
    SEAM_CUT = auto(), (
        "The header declares {declared} numbers or points: those after a seam in the file, which belong to another "
        "trace, are left out."
    )
    CHANNELS_UNLIKE_HEADER = auto(), "The header announces {announced:g} channels, but the file holds {held}."
    CHANNELS_OF_GEONET = auto(), "A GeoNet file holds 3 components, but this one holds {held}."
    LENGTH_UNLIKE_HEADER = auto(), (
        "The header gives the series a length of {stated_s:g} s, but its samples last {lasts_s:g} s."
    )
    RATE_NO_NUMBER = auto(), (
        "The header gives a rate of {rate!r}, which is not a number: the file may be damaged."
    )
    RATE_UNLIKE_STEP = auto(), (
        "The header gives a rate of {rate_hz:g} Hz, but duration and sample count give a step of "
        "{time_step_s:g} s."
    )
    MATCHED_TO_SPECTRUM = auto(), (
        "The header says that the record is matched to a spectrum: artificial, not a recorded motion."
    )
    SCALE_APPLIED = auto(), "Samples multiplied by the SCALE that the header states, {factor:g}."
    CALIBRATION_NOT_APPLIED = auto(), (
        "The header states a calibration of {factor:g}, which in this format converts to displacement: the samples "
        "are taken as they are, in the unit that is declared."
    )
    FACTOR_NOT_APPLIED = auto(), (
        "The text above the numbers mentions a factor or counts ({text}): no factor is applied, and the numbers are "
        "read as they are."
    )
    SENSITIVITY_ELSEWHERE = auto(), (
        "The overall sensitivity of {about} is stated at {at_hz:g} Hz and differs by {off:.0%} from the product of its "
        "stages at other frequencies: the sensitivity was used."
    )
    SENSITIVITY_UNLIKE_STAGES = auto(), (
        "The overall sensitivity of {about} is more than 5 % off what the stages of its response give at the "
        "frequency it is stated for; the stages were used: ask the network which of the two is valid."
    )
    # The dominant pulse of a record.
    PULSE_UNSTABLE = auto(), "The choice is unstable: another pulse often wins when the record is turned."
    PULSE_AT_AN_END = auto(), "The pulse touches an end of the record, so part of it may be missing."
    PULSE_FILTERED = auto(), "The pulse is long enough that the record's high-pass filter has reduced it."
    PULSE_SYMMETRIC = auto(), (
        "Two pulses of opposite sign, half a cycle apart, represent the motion equally well."
    )
    PULSE_AT_BAND_LIMIT = auto(), (
        "The period lies at a limit of the band that was searched, so the true pulse may lie outside it."
    )
    PULSE_RECORD_SHORT = auto(), "The record is shorter than the longest period sought, so that period was left out."
    PULSE_SAMPLING_COARSE = auto(), (
        "The sampling is too coarse for the upper frequency; shorter periods were left out."
    )
    PULSE_BESIDE_GAP = auto(), (
        "The record holds a run of identical samples longer than a second, which may be a gap that was filled."
    )

    # An integration.
    WEIGHTLESS = auto(), (
        "for an instant the ground falls faster than gravity, so that bodies would lose contact; the model keeps "
        "them on the ground."
    )
    # A structure, and where it stands.
    SIZE_UNUSUAL = auto(), (
        "{about} is {value:.6g}{unit}, but is usually between {low:g} and {high:g}{unit} for {type}; check the unit."
    )
    BROADER_THAN_TALL = auto(), (
        "{about} is {across_m:.6g} m and {height} {height_m:.6g} m: a body this broad slides before it rocks; check "
        "which is which."
    )
    HELD_AT_CEILING = auto(), (
        "{about} of type wall: taken as held at floor and ceiling; a wall that is free at its top, such as a "
        "boundary wall, is a free_wall."
    )
    FLOORS_BEHIND = auto(), (
        "It rocks inwards as freely as outwards, although the floors that it carries or is tied to are behind it; "
        "behind: floors or cross_walls, with the restitution of its impact on them, prevents this. Neither is always "
        "on the safe side, so assess both."
    )
    RESTITUTION_TYPED = auto(), (
        "The restitution of {typed:.2g} is typed, while the balance of momentum of the geometry gives {own:.2g}, "
        "with which less energy is lost: both are followed, and where their verdicts differ the share is a range."
    ), "{about}: restitution {typed:.2g} typed, {own:.2g} by geometry"
    RESTITUTION_ABOVE = auto(), (
        "The restitution of {typed:.2g} is typed, above the {own:.2g} that the balance of momentum gives for rigid "
        "bodies of this geometry: it rocks longer than they would; check it, or leave it out."
    )
    CRUSHING_WOULD_TELL = auto(), (
        "{about}: no compressive_strength is given. If the edges of the joints crush at 2 MPa, rocking starts at a "
        "lower acceleration (static_multiplier_crushing in structures.csv), which by the reserves under this record "
        "changes the verdict or moves the share that overturns by more than 0.1: give the strength."
    ), "{about}: crushing at 2 MPa would matter"
    HEAVY_ON_SUPPORT = auto(), (
        "{about} has {ratio:.2g} of the mass of {support}: beyond {limit:g} its reaction on the support changes "
        "rotations by more than one per cent, at 0.1 by 11 % in the median, and is left out here."
    )
    # Why the displacement of a limit state is what it is.
    LIMIT_SHARE = auto(), "{share:g} d₀"
    LIMIT_TIE_BREAKS = auto(), "a tie breaks"
    LIMIT_LOAD_FALLS = auto(), "what it carries falls"
    LIMIT_NOWHERE = auto(), "a vanishes nowhere"

    # A check of a code, and the conclusion on a structure at its design level.
    VERIFIED = auto(), "verified by {clause}"
    NOT_VERIFIED = auto(), "not verified by {clause}", "not verified"
    OTHER_SETS = auto(), "{share} of sets of other stations would meet it"
    OTHER_SETS_UNKNOWN = auto(), "too few stations to say what sets of other stations would give"
    CHECK_NOT_MET = auto(), "not met"
    DISPLACEMENT_EXCEEDED = auto(), "not met: d₀ is exceeded under {exceeding} of {motions} motions"
    SETS_TOO_FEW = auto(), (
        "met by this set, but not called met: only {sets} other sets lie within the limits, and {asked} are "
        "required; give more records, or a narrower range of periods"
    )
    SETS_DISAGREE = auto(), (
        "met by this set, but not called met: {share_percent:.0f} % of {sets} sets meet it, and {least_percent:.0f} "
        "% are required"
    )
    OTHER_STATIONS = auto(), (
        "That the check is met is no proof for other stations than the {stations} of the pool: even if it falls at "
        "none of these, it may fall at up to {unseen_percent:.0f} % of all stations, and as few as "
        "{least_percent:.0f} % of sets of other stations may meet the check, to judge by the stations and "
        "earthquakes of the pool."
    )
    NO_DISPLACEMENT = auto(), (
        "It cannot overturn: it {why}. The displacement d₀ that the nonlinear and the dynamic check require does not "
        "exist, so neither was made; the force in the ties is not checked."
    )
    # What holds a wall sideways. In motion: the largest forces of ties in 65 walls (theory: what the hold needs).
    TIE_MUST_BEAR = auto(), (
        "The tie at {height_m:.4g} m has no strength (tie_strength) and is assumed to hold: when the wall {about} it "
        "carries {needed_kN_m:.3g} kN/m statically, and in motion, with the impacts of the wall, about 2.8 times "
        "that (1.9 to 4.8 in eight of ten walls); give its strength."
    )
    TIE_BEARS = auto(), (
        "The tie at {height_m:.4g} m fails at {gives_kN_m:.3g} kN/m and carries {needed_kN_m:.3g} kN/m statically "
        "when the wall {about}; in motion, with the impacts of the wall, ties carried about 2.8 times the static "
        "force (1.9 to 4.8 in eight of ten walls)."
    )
    TIE_YIELDS = auto(), (
        "The tie at {height_m:.4g} m fails at {gives_kN_m:.3g} kN/m, before the wall {about}, for which it would "
        "have to carry {needed_kN_m:.3g} kN/m."
    )
    TOP_HOLDS = auto(), (
        "The top at {height_m:.4g} m needs {needed_kN_m:.3g} kN/m statically when the wall {about}; friction of "
        "{friction:.2g} under what lies on it, and ties there, provide {gives_kN_m:.3g} kN/m. In motion, with the "
        "impacts of the wall, it needs about 2.8 times the static force (1.9 to 4.8 in eight of ten walls)."
    )
    TOP_SLIPS = auto(), (
        "The top at {height_m:.4g} m slips: when the wall {about} it needs {needed_kN_m:.3g} kN/m, and friction of "
        "{friction:.2g} under what lies on it, and ties there, provide {gives_kN_m:.3g} kN/m, so the wall is "
        "computed as one that slips there; ties of {tie_kN_m:.3g} kN/m at the top (tie_heights) hold it statically, "
        "and in motion it needs about 2.8 times that force."
    ), "its top slips: it needs {needed_kN_m:.3g} kN/m, friction and ties provide {gives_kN_m:.3g}"
    TOP_MUST_BE_HELD = auto(), (
        "The top at {height_m:.4g} m is assumed to be held: when the wall {about} it needs {needed_kN_m:.3g} kN/m "
        "statically, and in motion, with the impacts of the wall, about 2.8 times that (1.9 to 4.8 in eight of ten "
        "walls)."
    )
    TOP_TAKEN_AS_HELD = auto(), (
        "The top is assumed to be held: when the wall {about} it needs {share:.2g} of the weight of the wall "
        "statically, and about 2.8 times that in motion, but no load on it is given, so no friction holds it."
    )
    # What was read of a file, and what was not.
    FIRST_NUMBERS = auto(), "The first of the numbers are not samples but {what}."
    UNLIKE_ITS_ANSWER = auto(), (
        "It is read as {answer!r}, as layouts.csv says, but looks different ({holds}): check whether it is like the "
        "other files of its folder."
    )
    ROW_FILLED_UP = auto(), "The last row is filled up with NaN, which are left out."
    LINE_ENDS_DOUBLED = auto(), (
        "The line ends are doubled (CR CR LF) by a faulty conversion; the numbers are unharmed."
    )
    FILES_NOT_READ = auto(), "Of the archive these files were not read: {names}."
    MORE_FILES_NOT_READ = auto(), "Of the archive these files were not read: {names} and {more} more."
    BLOCKS_OVERLAP = auto(), (
        "Blocks of {about} overlap by {overlap_s:g} s at {time}: repeated or overwritten."
    )
    BLOCKS_LEAP = auto(), (
        "Block number {after} follows number {before}: blocks are missing, repeated or overwritten."
    )
    TOLD_BY_OBSPY = auto(), "obspy: {text}."

    # Where a component points, and where its instrument stood.
    DIRECTION_UNKNOWN = auto(), (
        "The direction of the component {about} is unknown: its name is neither a direction nor an angle, and it is "
        "taken as horizontal; leave it out in the catalogue if it is not."
    )
    DIRECTION_CONTRADICTED = auto(), (
        "The header of {about} gives the direction {direction}, which the channel code contradicts; the header is "
        "followed: check which of the two is right, and name the horizontal ones in the column component."
    )
    SOME_MAY_BE_VERTICAL = auto(), (
        "Of the {channels} channels {names} may be vertical, because nothing says which one is: name the horizontal "
        "ones in the column component of the catalogue, or as --component."
    )
    LONE_MAY_BE_VERTICAL = auto(), (
        "The direction of the component {about} is unknown, because its name is neither a direction nor an angle, "
        "and it may be vertical: if it is horizontal, name it in the column component of the catalogue, or as "
        "--component."
    )
    VERTICAL_BY_NAME = auto(), (
        "Only the name of the file says that the motion is vertical ({word}): if it is horizontal, name it in the "
        "column component of the catalogue, or as --component."
    )
    VERTICAL_AS_HORIZONTAL = auto(), (
        "Component {about} is vertical, but the catalogue takes it as horizontal."
    )
    ANGLE_UNKNOWN = auto(), (
        "The angle between components {first} and {second} is not known: they are taken to be at right angles."
    )
    DOWN_HOLE = auto(), "The instrument stood down-hole ({place}): this is not the motion of the surface."
    IN_A_STRUCTURE = auto(), (
        "The instrument stood in a structure ({place}): its motion may not be that of the ground."
    )
    CHANNEL_NO_MOTION = auto(), "The channel code {about} is that of a {sensor}: leave the channel out."
    CHANNEL_OF_VELOCITY = auto(), (
        "The channel code {about} is that of a {sensor}, which measures velocity and clips in strong motion; an "
        "accelerometer has N in second place."
    )

    # The files of a folder, each beside the others.
    COUNTS_WITHOUT_UNIT = auto(), (
        "Without a unit its samples are taken as counts of the recorder: put the StationXML of the station beside "
        "it, or name it in the column inventory."
    )
    VERTICAL_IN_NAME = auto(), "The file's name says {word}, but {about} is taken as horizontal."
    STATIONS_UNLIKE = auto(), (
        "The stream holds channels of {number} stations ({stations}): they are not a record of one place; read each "
        "station separately."
    )
    STEPS_OF_STREAM_UNLIKE = auto(), (
        "The channels of the stream have time steps from {least_s:g} to {most_s:g} s: resample them before they are "
        "used together."
    )
    TILTED = auto(), (
        "The sensor {about} dips {dip_deg:g}°, neither level nor upright: its motion is taken along the nearer of the "
        "two."
    )
    CONTENT_REPEATED = auto(), (
        "Its content is that of {original}: listed as two records it would count twice."
    )
    NOT_SQUARE = auto(), "Components {first} and {second} are {angle_deg:g}° apart, not at right angles."
    COMPONENT_TWICE = auto(), "component {about} occurs {times} times"
    STEPS_UNLIKE = auto(), "their time steps are {least_s:g} and {most_s:g} s"
    BEGINNINGS_UNKNOWN = auto(), "they hold {least} and {most} samples and do not all say when they begin"
    COMPONENT_NOT_NAMED = auto(), "{about} does not name its component"
    TOO_MANY_COMPONENTS = auto(), "it has {horizontal} horizontal and {vertical} vertical components"
    POINT_THE_SAME_WAY = auto(), "components {first} and {second} point the same way"
    NOT_SQUARE_BY_NAME = auto(), (
        "components {first} and {second}, as the files' names end, are not at right angles"
    )
    DECLARED_BY_SOME = auto(), "not all of them declare unit and time step"

    # A catalogue and its folder, and a study before its run.
    FILE_RENAMED = auto(), "{about}: the file {before} is now {now}, by its content; the row names it."
    ROWS_TO_JOIN = auto(), (
        "{files} are components of one station: name them all in the row {rows} to join them."
    )
    READINGS_UNUSABLE = auto(), "{about}: {why}; every file is read again."
    RECORD_REPEATED = auto(), (
        "{about} ({file}): its content is that of {other} ({other_file}), so that one motion counts twice; leave one "
        "of them out."
    )
    FILE_UNLISTED = auto(), "{about} is not in the catalogue; rocking catalogue {folder} adds what is new."
    FILES_UNLISTED = auto(), "{files} files are not in the catalogue; rocking catalogue {folder} adds what is new."
    RECORD_GONE = auto(), (
        "{about} belongs to a record that is no longer in the catalogue; remove it if you do not need it."
    )
    OTHER_VERSION = auto(), "The results are of another version of rocking; they are recomputed."
    OUTDATED = auto(), "{about}: {why}; recompute it with: rocking run . {about}."
    # fmt: on


@dataclass(frozen=True)
class Remark:
    """One thing to say: its kind, what it is about, and its values by name, in SI units unless their names say else.

    values: in the order of `Kind.value_names`. Raises ValueError for an unknown kind, and where the values are not
    those that its sentence names.

    >>> from rocking.remarks import Kind
    >>> str(rocking.Remark(Kind.CONTACTS_OPEN))
    'contacts open'
    """

    kind: Kind
    about: str = ""
    values: tuple[tuple[str, Value], ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.kind, Kind):
            raise ValueError(f"remark {self.kind!r} is of no kind of the catalogue.")
        given = [name for name, _ in self.values]
        if given != list(self.kind.value_names):
            raise ValueError(
                f"remark {self.kind}: values {given}, but must be {list(self.kind.value_names)}."
            )
        for name, value in self.values:
            if not isinstance(value, Value):
                raise ValueError(f"remark {self.kind}: {name} is {value!r}, but must be a text or a number.")

    @classmethod
    def of(cls, kind: Kind, about: str = "", **values: Value) -> "Remark":
        """Return the remark of `kind` about a file, a record or a structure, with its values by name."""
        return cls(kind, about, tuple(sorted(values.items())))

    def __getitem__(self, name: str) -> Value:
        """Return one of the values. Raises KeyError for a name that the sentence does not have."""
        return dict(self.values)[name]

    def __str__(self) -> str:
        """The remark in words; what it is about stands before a sentence that does not name it."""
        words = self.kind.sentence.format(about=self.about, **dict(self.values))
        return f"{self.about}: {words}" if self.about and not self.kind.names_subject else words

    @property
    def brief(self) -> str:
        """The remark in as few words as a line of a table has room for."""
        return self.kind.brief.format(about=self.about, **dict(self.values))
