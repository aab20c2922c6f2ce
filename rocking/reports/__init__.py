"""Reports: the PDF of one record, the PDF of all of them, and the figures in them."""

from rocking.reports.record import failure_report, record_report
from rocking.reports.summary import summary_report

__all__ = ["failure_report", "record_report", "summary_report"]
