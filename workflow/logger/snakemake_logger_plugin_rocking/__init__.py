"""What the scheduler does, told to the `rocking run` that started it: a logger plug-in of snakemake."""

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from rocking.study.progress import Progress


class LogHandler(LogHandlerBase):
    """Tells the plan and the errors of a run; snakemake's own log stays as it is."""

    writes_to_stream = writes_to_file = needs_rulegraph = False
    has_filter = has_formatter = True

    def emit(self, record):
        """Tell what the reader of a terminal wants to know of an event."""
        event, progress = getattr(record, "event", None), Progress.in_this_process
        if progress and event == LogEvent.RUN_INFO:
            progress.count_jobs(record.stats)
        elif progress and event == LogEvent.ERROR:
            progress.errors.append(record.getMessage())
