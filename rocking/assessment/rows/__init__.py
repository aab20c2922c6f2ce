"""The rows of the result tables: each class says what its columns are, and a function beside it fills them."""
