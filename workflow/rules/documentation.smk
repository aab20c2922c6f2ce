"""Set the documentation, filled from the code that it describes: snakemake documentation."""


rule documentation:
    input:
        pages=sorted(
            str(path)
            for path in (HOME / "docs").rglob("*")
            if path.suffix in (".css", ".js", ".md", ".py", ".svg", ".yml") and "research" not in path.parts
        ),
    output:
        directory(f"{RESULTS}/documentation"),
    log:
        f"{RESULTS}/summary/logs/documentation.log",
    params:
        package_sha256=package_sha256(),
    message:
        "Set the documentation"
    run:
        run_apart(SETTINGS, log[0], "docs.site.build:documentation", output[0])
