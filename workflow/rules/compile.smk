"""Compile the integration once, before jobs that run side by side would each do so for themselves."""

FLAG = f"{SUMMARY}/logs/compiled"
COMPILED = FLAG if len(PLAN.jobs) > 1 else []


rule compile:
    output:
        touch(FLAG),
    log:
        f"{SUMMARY}/logs/compile.log",
    benchmark:
        f"{SUMMARY}/benchmarks/compile.tsv"
    threads: 2
    params:
        package_sha256=PLAN.package_sha256,
    message:
        "Compile the integration"
    script:
        "../scripts/compile.py"
