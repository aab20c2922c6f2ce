"""The shipped example: a study like any other, which takes the workflow over."""


configfile: "config/config.yaml"


module rocking:
    snakefile:
        "workflow/Snakefile"
    config:
        config


use rule * from rocking
