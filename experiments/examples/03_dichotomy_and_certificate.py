"""03: the paper's dichotomy, and a proof about its walk that holds between samples, too."""
import halfstep as hs

experiment = hs.Experiment("fig3_two_half_steps")
result = experiment.smooth("dichotomy")
print(f"{experiment.planned.duration:.3f} -> {result.duration:.3f} s, {result.status}")
row = result.overlaps.row(0)
print(f"the overlap of {row['overlap_s']:.3f} s is held by: {row['limited_by']}")

certificate = result.certify()
print(f"{certificate.status}: {certificate.sentence}")

too_much = experiment.walk(overlaps=[row["overlap_s"] + 0.05])
print(f"0.05 s more: {too_much.certify().status}: {too_much.certify().sentence}")
