"""One record: read it with obspy, extract its pulses, predict each structure, integrate it, and compare the two."""


rule record:
    input:
        **lists_of("record/{record}"),
    output:
        files_of("record/{record}"),
    log:
        log_file("record/{record}"),
    threads: cores_of_record
    resources:
        mem_mb=memory_of_record,
        runtime=60,
    params:
        *params_of("record/{record}"),
    message:
        "Record {wildcards.record}"
    run:
        work(rule, wildcards, input, params, log, threads)
