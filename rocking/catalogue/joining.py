"""Joining: when the files of one station are one motion, and what they hold on one span of time."""

from collections import Counter
from collections.abc import Sequence
from datetime import datetime

import numpy as np

from rocking.catalogue.listing import ListedChannel, without_samples
from rocking.errors import RecordError
from rocking.records.formats.peer import PEER_AT2
from rocking.records.kinds import RecordKind
from rocking.signal.accelerogram import SAME_STEP, Accelerogram
from rocking.warnings import RockingWarning

LONGEST_TAIL = 0.02
"""Share of the longest file that it may last beyond the shortest one where no file says when it begins.

The channels of one recorder start together, and processing cuts each at an end of its own: by at most 1.5 % of real
stations. What differs by more is another record, or lacks its beginning; of PEER it is reported.
"""
_OFF_GRID = 0.1  # share of a time step by which the samples of two files may lie between one another


def why_apart(channels: Sequence[ListedChannel]) -> RockingWarning | None:
    """Return why channels of several files cannot be one station's; None where they can.

    Files of PEER, which never say when they begin, are one record at any length that leaves out nothing of D5–95. That
    they begin together is assumed, and reported: of Erzincan 1992 the longer one may begin half a second earlier, and
    no comparison of the samples decides that. Envelopes of components that do begin together lie .3 s apart, too.
    """
    names = Counter(channel.component for channel in channels if not channel.borehole)
    if twice := next((name for name, n in names.items() if n > 1), ""):
        return RockingWarning.of(RecordKind.COMPONENT_TWICE, twice, times=names[twice])
    steps = [channel.time_step for channel in channels]
    if max(steps) / min(steps) - 1 > SAME_STEP:
        return RockingWarning.of(RecordKind.STEPS_UNLIKE, least_s=min(steps), most_s=max(steps))
    have_starts = [bool(channel.start_time) for channel in channels]
    samples = [channel.samples for channel in channels]
    is_still = all(
        channel.format == PEER_AT2.name and channel.shaking <= min(samples) for channel in channels
    )
    allowed = 0 if any(have_starts) else LONGEST_TAIL * max(samples)
    if max(samples) - min(samples) > allowed and not (all(have_starts) or is_still):
        return RockingWarning.of(RecordKind.BEGINNINGS_UNKNOWN, least=min(samples), most=max(samples))
    return None


def joined(channels: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return the channels of several files on their common span. Raises RecordError when they do not fit together."""
    if why := why_apart([without_samples(channel, is_known=False) for channel in channels]):
        raise RecordError(
            f"its files do not fit together: {why}; give each file a row of its own.", files=str(why)
        )
    if all(channel.start_time for channel in channels):
        return _on_common_span(channels)
    return _to_the_shortest(channels)


def _on_common_span(channels: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return channels that all say when they begin, from the latest start to the earliest end."""
    step = channels[0].time_step
    starts = [datetime.fromisoformat(channel.start_time).timestamp() for channel in channels]
    late = (max(starts) - np.array(starts)) / step
    first = np.round(late).astype(int).tolist()
    off = np.abs(late - first).max()
    if off > _OFF_GRID:
        raise RecordError(
            f"resample the files: their samples lie {off:.2g} of a step between one another.", start_time=off
        )
    size = min(channel.acceleration.size - place for channel, place in zip(channels, first, strict=True))
    if size < 2:
        raise RecordError(
            "the files have no span of time in common; give each file a row of its own.", samples=size
        )
    begin = channels[int(np.argmax(starts))].start_time
    sentence = f"Cut to the span common to the station's files, {size * step:g} s from {begin} on."
    cut = []
    for channel, place in zip(channels, first, strict=True):
        samples = channel.acceleration[place : place + size]
        is_whole = samples.size == channel.acceleration.size
        cut.append(channel if is_whole else channel.processed_by(samples, sentence, start_time=begin))
    return cut


def _to_the_shortest(channels: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return channels that do not say when they begin from the first sample of each to the end of the shortest."""
    sizes = [channel.acceleration.size for channel in channels]
    size, longest = min(sizes), max(sizes)
    apart = (longest - size) * channels[0].time_step
    unlike = RockingWarning.of(RecordKind.LENGTHS_UNLIKE, least=size, most=longest, apart_s=apart)
    warnings = [unlike] if longest - size > LONGEST_TAIL * longest else []
    cut = []
    for channel in channels:
        if surplus := channel.acceleration.size - size:
            sentence = (
                f"The last {surplus} samples left out: the station's shortest file holds {size}, and all are taken to "
                "begin together."
            )
            channel = channel.processed_by(channel.acceleration[:size], sentence)
        cut.append(channel.warned(*warnings))
    return cut


SQUARE = 5.0
"""Degrees by which two components may be off a right angle without a word."""
