"""Set the documentation, filled from the code it describes: snakemake documentation."""

from rocking.documentation import PAGES


rule documentation:
    input:
        pages=[str(page.path) for page in PAGES],
        schemas=[
            f"{workflow.basedir}/workflow/schemas/{name}.schema.yaml"
            for name in ("config", "structures")
        ],
        settings=f"{workflow.basedir}/workflow/config.yaml",
    output:
        [f"{RESULTS}/documentation/{page.name}.html" for page in PAGES],
    log:
        f"{RESULTS}/documentation/log.txt",
    params:
        package_sha256=PACKAGE,
    message:
        "Set the documentation"
    script:
        "../scripts/documentation.py"
