"""One record, or those of a batch, in five steps: snakemake.* onto rocking.study.job."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from rocking.study.job import begin_job, steps_of
from rocking.study.results import outcome_of

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    for record in job.records:
        with steps_of(record, job) as step:
            motion = step.read()  # 1: by obspy, or by a reader of ours where it has none
            components = step.pulses(motion)  # 2: the sine pulses that dominate it
            predictions = step.predict(components)  # 3: the closed form of each equivalent block
            responses = step.integrate(motion, components, predictions)  # 4: under the whole record
            step.compare(responses)  # 5: and decide, report and keep the outcome
    job.finish([*snakemake.output, *(outcome_of(job.results, record.id) for record in job.records)])
