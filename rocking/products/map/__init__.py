"""Where it happened: the stations of a study, what each recorded, and what became of every structure there."""
