"""What accuracy costs, on records and structures of this study, and which method to choose."""


rule trade:
    input:
        **lists_of("trade"),
    output:
        files_of("trade"),
    log:
        log_file("trade"),
    resources:
        mem_mb=2000,
        runtime=120,
    params:
        *params_of("trade"),
    message:
        "Measure the error and the time of every method"
    run:
        work(rule, wildcards, input, params, log)
