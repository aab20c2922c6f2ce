"""Many records of a study without reports, one after another in one process: a start costs as much as twenty of them."""


rule batch:
    input:
        unless_sealed("batches/{batch}"),
    output:
        seal=seal_of("batches/{batch}"),
    log:
        f"{SUMMARY}/logs/batches/{{batch}}.log",
    params:
        product=product_of("batches/{batch}"),
        key=key_of("batches/{batch}"),
    message:
        "Batch {wildcards.batch}"
    script:
        "../scripts/record.py"
