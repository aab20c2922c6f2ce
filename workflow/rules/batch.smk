"""Many records of a study without reports, one after another in one process: a start costs as much as twenty of them."""


rule batch:
    input:
        **lists_of("batch/{batch}"),
    output:
        files_of("batch/{batch}"),
    log:
        log_file("batch/{batch}"),
    resources:
        mem_mb=memory_of_record,
        runtime=240,
    params:
        *params_of("batch/{batch}"),
    message:
        "Batch {wildcards.batch}"
    run:
        work(rule, wildcards, input, params, log)
