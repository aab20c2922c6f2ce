"""What the scheduler does, told to the `rocking run` that started it: a logger plug-in of snakemake."""

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from rocking.study.terminal import send


class LogHandler(LogHandlerBase):
    """Sends the plan and the errors of a run; snakemake's own log stays as it is."""

    writes_to_stream = writes_to_file = needs_rulegraph = False
    has_filter = has_formatter = True

    def emit(self, record):
        """Send what the reader of a terminal wants to know of an event."""
        event = getattr(record, "event", None)
        if event == LogEvent.RUN_INFO:
            send(planned={name: number for name, number in record.stats.items() if name != "total"})
        elif event == LogEvent.ERROR:
            send(error=record.getMessage())
