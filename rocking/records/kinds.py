"""The kinds of warnings on files, samples of records and the catalogue, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class RecordKind(Kind):
    """A kind of warning on a file, the samples of a record or the catalogue."""

    # fmt: off
    # The samples of a record.
    PEAK_RARE = auto(), """The peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded ground
        motion is so strong; check unit and file."""
    VELOCITY_RARE = auto(), """The peak velocity is {velocity_m_s:.3g} m/s, above {rare_m_s:g} m/s: hardly any
        recorded ground motion is so fast; check unit and file."""
    PEAK_TINY = auto(), "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit."
    PEAK_TINY_BY_UNIT = auto(), """The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong
        unit; multiplied {factors} it would be plausible."""
    SAMPLE_ALONE = auto(), """The sample at {time_s:g} s is {peak_g:.3g} g and stands alone; without it the
        peak acceleration is {others_g:.3g} g: a number is damaged, or the instrument was struck."""
    ZEROS_IN_SHAKING = auto(), "Within the strong shaking {samples} samples in a row are zero: a filled gap?"
    STILL_STRETCH = auto(), """From {time_s:g} s on {samples} samples in a row are the same, while those
        before and after change: a filled gap?"""
    ROW_REPEATED = auto(), """At {time_s:g} s all channels repeat the sample before: a row of numbers is
        repeated."""
    HALF_REPEATED = auto(), """The second half of the samples repeats the first, {samples} numbers: the file
        may be appended to itself."""
    NEVER_NEGATIVE = auto(), """No number of {about} is below zero: it is a spectrum, a series of magnitudes,
        or a record whose offset was not removed."""
    NUMBER_CUT = auto(), """The last number has fewer decimals than those above it and no line end: the file
        may be cut."""
    UNEVEN = auto(), """The {samples} samples are unevenly spaced; interpolated linearly to {number} at their
        median step, {time_step_s:g} s."""
    UNEVEN_FILM = auto(), """The {samples} samples are unevenly spaced; interpolated linearly to {number},
        {time_step_s:g} s apart."""

    # The header of a record against its samples.
    PEAK_UNLIKE_HEADER = auto(), """The peak is {peak_m_s2:.6g} m/s², but the header states {stated_m_s2:.6g}
        m/s², which is more than rounding: a number or a factor is damaged."""
    PEAK_ELSEWHERE = auto(), """The header puts the peak at {stated_s:g} s, but it occurs at {time_s:g} s:
        lines may be missing, repeated or out of order before it, or the time step differs."""
    MEAN_SQUARE_UNLIKE_HEADER = auto(), """The root mean square of the samples is {value:.6g} {unit}, but the
        header states {stated:.6g} {unit}: numbers are damaged, missing or repeated, or a factor is wrong."""
    VELOCITY_UNLIKE_THERE = auto(), """Around {time_s:g} s the file's own velocity is not the integral of its
        acceleration: numbers of one of them are damaged there."""
    VELOCITY_UNLIKE = auto(), """The file's own velocity is not the integral of its acceleration: it is
        damaged."""
    SAMPLES_SURPLUS = auto(), """The header declares {declared} samples; the file holds {held}, and all
        are used."""
    LINES_SURPLUS = auto(), """The header declares {declared} samples; surplus lines at the end that repeat those
        before, {lines}, are left out."""
    SEAM_CUT = auto(), """The header declares {declared} numbers or points: those after a seam in the file,
        which belong to another trace, are left out."""
    CHANNELS_UNLIKE_HEADER = auto(), "The header announces {announced:g} channels, but the file holds {held}."
    CHANNELS_OF_GEONET = auto(), "A GeoNet file holds 3 components, but this one holds {held}."
    LENGTH_UNLIKE_HEADER = auto(), """The header gives the series a length of {stated_s:g} s, but its samples
        last {lasts_s:g} s."""
    RATE_NO_NUMBER = auto(), """The header gives a rate of {rate!r}, which is not a number: the file may be
        damaged."""
    RATE_UNLIKE_STEP = auto(), """The header, or the StationXML, gives a rate of {rate_hz:g} Hz, but the
        record has a step of {time_step_s:g} s, which is used."""
    MATCHED_TO_SPECTRUM = auto(), """The header says that the record is matched to a spectrum: artificial, not
        a recorded motion."""
    SCALE_APPLIED = auto(), "Samples multiplied by the SCALE that the header states, {factor:g}."
    CALIBRATION_NOT_APPLIED = auto(), """The header states a calibration of {factor:g}, which in this format
        converts to displacement: the samples are taken as they are, in the unit that is declared."""
    FACTOR_NOT_APPLIED = auto(), """The text above the numbers mentions a factor or counts ({text}): no factor
        is applied, and the numbers are read as they are."""
    SENSITIVITY_ELSEWHERE = auto(), """The overall sensitivity of {about} is stated at {at_hz:g} Hz and
        differs by {off:.0%} from the product of its stages at other frequencies: the sensitivity was used."""
    SENSITIVITY_UNLIKE_STAGES = auto(), """The overall sensitivity of {about} is more than 5 % off what the
        stages of its response give at the frequency it is stated for; the stages were used: ask the network
        which of the two is valid."""

    # What was read of a file, and what was not.
    FIRST_NUMBERS = auto(), "The first of the numbers are not samples but {what}."
    UNLIKE_ITS_ANSWER = auto(), """It is read as {answer!r}, as layouts.csv says, but looks different
        ({holds}): check whether it is like the other files of its folder."""
    TAIL_PASSED_OVER = auto(), "Text below the numbers is passed over: {text!r}."
    ROW_FILLED_UP = auto(), "The last row is filled up with NaN, which are left out."
    LINE_ENDS_DOUBLED = auto(), """The line ends are doubled (CR CR LF) by a faulty conversion; the numbers
        are unharmed."""
    FILES_NOT_READ = auto(), "Of the archive these files were not read: {names}."
    BLOCKS_OVERLAP = auto(), """Blocks of {about} overlap by {overlap_s:g} s at {time}: repeated or
        overwritten."""
    BLOCKS_LEAP = auto(), """Block number {after} follows number {before}: blocks are missing, repeated or
        overwritten."""
    FAILED_IN_GMPROCESS = auto(), "gmprocess rejects this record: {reason}; check whether it can be used."
    WARNING_OF_OBSPY = auto(), "obspy: {text}."

    # Where a component points, and where its instrument stood.
    DIRECTION_UNKNOWN = auto(), """The direction of the component {about} is unknown: its name is neither a
        direction nor an angle, and it is taken as horizontal; leave it out in the catalogue if it is not."""
    DIRECTION_CONTRADICTED = auto(), """The header of {about} gives the direction {direction}, which the
        channel code contradicts; the header is followed: check which of the two is right, and name the
        horizontal ones in the column component."""
    DIRECTION_SAID_TWICE = auto(), """The file gives two directions, {other} and {about}: the second, which is said of
        the component itself, is followed."""
    ORIENTATION_UNKNOWN = auto(), """The StationXML says that the orientation of {about} is not known: its azimuth
        is not used."""
    SAME_MOTION = auto(), """The samples of {about} are those of {other}, sample by sample, or their negative: one
        of the two is a copy, and a study counts them once."""
    SOME_MAY_BE_VERTICAL = auto(), """Of the {channels} channels {names} may be vertical, because nothing says
        which one is: name the horizontal ones in the column component of the catalogue, or as --component."""
    LONE_MAY_BE_VERTICAL = auto(), """The direction of the component {about} is unknown, because its name is
        neither a direction nor an angle, and it may be vertical: if it is horizontal, name it in the column
        component of the catalogue, or as --component."""
    VERTICAL_BY_NAME = auto(), """Only the name of the file says that the motion is vertical ({word}): if it
        is horizontal, name it in the column component of the catalogue, or as --component."""
    VERTICAL_AS_HORIZONTAL = auto(), """Component {about} is vertical, but the catalogue takes it as
        horizontal."""
    ANGLE_UNKNOWN = auto(), """The angle between components {first} and {second} is not known: they are taken
        to be at right angles."""
    DOWN_HOLE = auto(), "The instrument stood down-hole ({place}): this is not the motion of the surface."
    IN_A_STRUCTURE = auto(), """The instrument stood in a structure ({place}): its motion may not be that of
        the ground."""
    CHANNEL_NO_MOTION = auto(), "The channel code {about} is that of a {sensor}: leave the channel out."
    CHANNEL_OF_VELOCITY = auto(), """The channel code {about} is that of a {sensor}, which measures velocity
        and clips in strong motion; an accelerometer has N in second place."""

    # The files of a folder, each compared with the others.
    COUNTS_WITHOUT_UNIT = auto(), """Without a unit its samples are taken as counts of the recorder: put the
        StationXML of the station in its folder, or name it in the column inventory."""
    DIRECTION_IN_NAME = auto(), "The file's name says {word}, but it holds {about}, which is followed."
    STATIONS_UNLIKE = auto(), """The stream holds channels of {number} stations ({stations}): they are not a
        record of one place; read each station separately."""
    STEPS_OF_STREAM_UNLIKE = auto(), """The channels of the stream have time steps from {least_s:g} to
        {most_s:g} s: resample them before they are used together."""
    TILTED = auto(), """The sensor {about} dips {dip_deg:g}°, neither level nor upright: its motion is taken
        along the nearer of the two."""
    CONTENT_REPEATED = auto(), """Its content is that of {original}: listed as two records it would count
        twice."""
    NOT_SQUARE = auto(), "Components {first} and {second} are {angle_deg:g}° apart, not at right angles."
    COMPONENT_TWICE = auto(), "component {about} occurs {times} times"
    STEPS_UNLIKE = auto(), "their time steps are {least_s:g} and {most_s:g} s"
    BEGINNINGS_UNKNOWN = auto(), "they hold {least} and {most} samples and do not all say when they begin"
    LENGTHS_UNLIKE = auto(), """The components of this record hold {least} to {most} samples, and none says when
        it begins: they are taken to begin together, and are cut to the shortest; if they end together instead,
        they are out of step by up to {apart_s:.3g} s, and so is what is rotated of them to another direction."""
    COMPONENT_NOT_NAMED = auto(), "{about} does not name its component"
    TOO_MANY_COMPONENTS = auto(), "it has {horizontal} horizontal and {vertical} vertical components"
    POINT_THE_SAME_WAY = auto(), "components {first} and {second} point the same way"
    NOT_SQUARE_BY_NAME = auto(), """components {first} and {second}, as the files' names end, are not at right
        angles"""
    DECLARED_BY_SOME = auto(), "not all of them declare unit and time step"

    # A catalogue and its folder, and a study before its run.
    FILE_RENAMED = auto(), "{about}: the file {before} is now {now}, by its content; the row names it."
    ROWS_TO_JOIN = auto(), """{files} are components of one station: name them all in the row {rows} to join
        them."""
    ANSWER_IDLE = auto(), """{about}, line {line}: the answer {answer!r} fits no file that lies here; remove
        the line."""
    READINGS_UNUSABLE = auto(), "{about}: {why}; every file is read again."
    RECORD_REPEATED = auto(), """{about} ({file}): its content is that of {other} ({other_file}), so that one
        motion counts twice; leave one of them out."""
    PLACE_IMPOSSIBLE = auto(), """{latitude} is {north_deg:g} and {longitude} is {east_deg:g}, but must be -90
        to 90 and -180 to 180: the place is left out; correct the catalogue."""
    PLACE_SWAPPED = auto(), """{latitude} is {north_deg:g}, beyond ±90, and {longitude} is {east_deg:g}: they
        look swapped; the place is left out until the catalogue is corrected."""
    PLACE_HALF = auto(), """The catalogue gives {given} without {missing}: the place is left out until both
        are given."""
    PLACE_UNLIKE_FILE = auto(), """The catalogue places the station at {catalogue}, the file at {file},
        {distance_km:.3g} km apart: the catalogue's place is used; correct it if it errs."""
    FILES_UNLISTED = auto(), "Not in the catalogue: {files}; rocking catalogue {folder} adds what is new."
    # fmt: on
