"""Measure what accuracy costs, on records and structures of this study, and say which method to buy."""


rule trade:
    output:
        table=f"{SUMMARY}/trade.csv",
        description=f"{SUMMARY}/trade.json",
        pdf=f"{SUMMARY}/trade.pdf",
        svg=f"{SUMMARY}/trade.svg",
        seal=f"{SUMMARY}/{TRADE_SEAL}",
    log:
        f"{SUMMARY}/logs/trade.log",
    benchmark:
        f"{SUMMARY}/benchmarks/trade.tsv"
    params:
        **PLAN.params(),
        made_from=PLAN.trade_made_from,
    message:
        "Measure the error and the time of every method"
    script:
        "../scripts/trade.py"
