"""Products: what stands over all records beside the summary, each in its folder, listed in `rocking.study.products`."""
