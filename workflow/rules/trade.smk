"""What accuracy costs, on records and structures of this study, and which method to choose."""


rule trade:
    input:
        unless_sealed("trade"),
    output:
        table=f"{SUMMARY}/trade.csv",
        description=f"{SUMMARY}/trade.json",
        pdf=f"{SUMMARY}/trade.pdf",
        svg=f"{SUMMARY}/trade.svg",
        figures=f"{SUMMARY}/trade_figures.zip" if DRAWS else [],
        rows=str(kept_of(Path(RESULTS), "trade")),
        seal=seal_of("trade"),
    log:
        f"{SUMMARY}/logs/trade.log",
    params:
        product="trade",
        key=key_of("trade"),
    message:
        "Measure the error and the time of every method"
    script:
        "../scripts/trade.py"
