"""All records: their tables, the report on them, the page to explore and the workbook."""


rule summary:
    input:
        **lists_of("summary"),
        **{product.name: shown_files(product.name) for product in PRODUCTS},
        records=OUTCOMES,
    output:
        files_of("summary"),
    log:
        log_file("summary"),
    resources:
        mem_mb=4000,
        runtime=120,
    params:
        *params_of("summary"),
    message:
        "Summary of all records"
    run:
        work(rule, wildcards, input, params, log)
