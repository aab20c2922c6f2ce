"""What stands over all records beside the summary: a rule for each product of rocking.study.products, all of one text.

In such a loop a function that is called later sees the last product: whatever differs is handed over by its name.
"""

from rocking.study.products import PRODUCTS

for PRODUCT in PRODUCTS:

    rule:
        name:
            PRODUCT.name
        input:
            **lists_of(PRODUCT.name),
            records=OUTCOMES if PRODUCT.after_records else [],
        output:
            files_of(PRODUCT.name),
        log:
            log_file(PRODUCT.name),
        resources:
            mem_mb=PRODUCT.memory_mb,
            runtime=PRODUCT.minutes,
        params:
            *params_of(PRODUCT.name),
        message:
            f"{PRODUCT.name}: {PRODUCT.does}"
        run:
            work(rule, wildcards, input, params, log, job="product")
