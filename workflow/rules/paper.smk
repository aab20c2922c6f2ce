"""Redraw the figures of the source paper with their data, and decide its equations by numbers."""


rule paper:
    input:
        catalogue=f"{HOME}/records/near_fault.csv",
        source=sorted(str(path) for path in (HOME / "docs" / "paper").iterdir() if path.is_file()),
    output:
        directory(f"{RESULTS}/paper"),
    log:
        f"{RESULTS}/summary/logs/paper.log",
    params:
        package_sha256=package_sha256(),
    message:
        "Redraw the figures of the paper"
    run:
        run_apart(SETTINGS, log[0], "docs.paper.write:paper", input.catalogue, SETTINGS.mirror, output[0])
