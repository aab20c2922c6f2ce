"""Products: what is made of all records besides the summary, each in its folder, listed in `rocking.study.products`."""
