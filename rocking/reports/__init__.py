"""Reports: the PDF of one record, the PDF of all of them, and the figures in them."""
