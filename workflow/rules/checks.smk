"""Every structure checked at the design level of the study by the code, with a page of each to sign."""


rule checks:
    input:
        **lists_of("checks"),
        records=OUTCOMES,
    output:
        files_of("checks"),
    log:
        log_file("checks"),
    resources:
        mem_mb=2000,
        runtime=120,
    params:
        *params_of("checks"),
    message:
        "Check the structures at the design level"
    run:
        work(rule, wildcards, input, params, log)
