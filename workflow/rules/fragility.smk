"""The fragility of every structure under all records of the study."""


rule fragility:
    input:
        **lists_of("fragility"),
    output:
        files_of("fragility"),
    log:
        log_file("fragility"),
    resources:
        mem_mb=4000,
        runtime=480,
    params:
        *params_of("fragility"),
    message:
        "Scale the records until the structures overturn"
    run:
        work(rule, wildcards, input, params, log)
