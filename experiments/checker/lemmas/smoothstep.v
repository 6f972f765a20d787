(* wpg/README.md, "Half-step": the C² step S and its form S_r with constant speed in the middle;
   smoothing/README.md, "Motion bounds": "For the smoothstep sup|π̈| on a stretch is exact".
   C++: Smoothstep::At, SecondBound and ThirdRange (wpg/motion/smoothstep.h), RampedStep
   (wpg/motion/ramped_step.h), all on the window [0, 1]: x stands for (σ − begin)/(end − begin).
   Assumes r in (0, ½] for S_r, as FootProfile checks. *)
Require Import Reals Lra Psatz.
From Halfstep Require Import calculus.
Open Scope R_scope.

Definition S (x : R) := x * x * x * (10 + x * (-15 + 6 * x)).
Definition S1 (x : R) := 30 * x * x * (1 - x) * (1 - x).
Definition S2 (x : R) := 60 * x * (1 - x) * (1 - 2 * x).
Definition S3 (x : R) := 60 * (1 - 6 * x * (1 - x)).

Lemma S_0 : S 0 = 0.
Proof. unfold S. ring. Qed.

Lemma S_1 : S 1 = 1.
Proof. unfold S. ring. Qed.

(* S(x) + S(1 − x) = 1. *)
Lemma S_antisymmetric x : S x + S (1 - x) = 1.
Proof. unfold S. ring. Qed.

(* What Smoothstep::At returns are the derivatives. *)
Lemma S_first x : derivable_pt_lim S x (S1 x).
Proof. unfold S, S1. derive. ring. Qed.

Lemma S_second x : derivable_pt_lim S1 x (S2 x).
Proof. unfold S1, S2. derive. ring. Qed.

Lemma S_third x : derivable_pt_lim S2 x (S3 x).
Proof. unfold S2, S3. derive. ring. Qed.

(* C²: with the constants before and after, S has two derivatives everywhere, which are those of
   At; the second is continuous, since it has a derivative inside and is 0 at both ends. *)
Theorem S_is_C2 x :
  derivable_pt_lim (fun t => S (clamp t)) x (S1 (clamp x)) /\
  derivable_pt_lim (fun t => S1 (clamp t)) x (S2 (clamp x)) /\
  continuity_pt (fun t => S2 (clamp t)) x.
Proof.
  split; [ | split].
  - apply (d_clamped S S1); [exact S_first | unfold S1; ring | unfold S1; ring].
  - apply (d_clamped S1 S2); [exact S_second | unfold S2; ring | unfold S2; ring].
  - apply (continuity_pt_comp clamp S2).
    + intros eps Heps. exists eps. split; [exact Heps | ]. intros y [_ near]. simpl in *.
      unfold R_dist in *. eapply Rle_lt_trans; [apply clamp_near | exact near].
    + apply derivable_continuous_pt. exists (S3 (clamp x)). apply S_third.
Qed.

Lemma S1_pos x : 0 <= S1 x.
Proof. unfold S1. replace (30 * x * x * (1 - x) * (1 - x)) with (30 * (x * (1 - x)) ^ 2) by ring.
  apply Rmult_le_pos; [lra | apply pow2_ge_0]. Qed.

Lemma S_increasing x y : x <= y -> S x <= S y.
Proof. intros le. apply (rises S S1); [exact le | intros; apply S_first | intros; apply S1_pos]. Qed.

Lemma S_range x : 0 <= x <= 1 -> 0 <= S x <= 1.
Proof.
  intros [low high]. pose proof (S_increasing 0 x low). pose proof (S_increasing x 1 high).
  pose proof S_0. pose proof S_1. lra.
Qed.

(* S' ≤ 15/8. *)
Lemma S1_steepest x : 0 <= x <= 1 -> S1 x <= 15 / 8.
Proof.
  intros [low high]. unfold S1. pose proof (pow2_ge_0 (x - 1 / 2)).
  assert (0 <= x * (1 - x) <= 1 / 4) by (split; nra).
  replace (30 * x * x * (1 - x) * (1 - x)) with (30 * ((x * (1 - x)) * (x * (1 - x)))) by ring.
  nra.
Qed.

Lemma S_steepest x y : 0 <= x -> x <= y -> y <= 1 -> S y - S x <= 15 / 8 * (y - x).
Proof.
  intros low le high.
  pose proof (rises (fun t => 15 / 8 * t - S t) (fun t => 15 / 8 - S1 t) x y le) as rise.
  enough (15 / 8 * x - S x <= 15 / 8 * y - S y) by lra.
  apply rise.
  - intros t _. apply d_minus; [ | apply S_first]. derive. ring.
  - intros t inside. pose proof (S1_steepest t). lra.
Qed.

(* S'' is extremal at ½ ± 1/√12, where it is ∓10/√3. *)
Definition low_peak := (1 - / sqrt 3) / 2.
Definition high_peak := (1 + / sqrt 3) / 2.

Lemma inverse_root : / sqrt 3 * / sqrt 3 = 1 / 3 /\ 0 < / sqrt 3.
Proof.
  assert (0 < sqrt 3) by (apply sqrt_lt_R0; lra). split.
  - rewrite <- Rinv_mult. rewrite sqrt_sqrt by lra. lra.
  - apply Rinv_0_lt_compat. assumption.
Qed.

Lemma S3_roots x : S3 x = 360 * (x - low_peak) * (x - high_peak).
Proof.
  unfold S3, low_peak, high_peak. destruct inverse_root as [square _].
  replace (360 * (x - (1 - / sqrt 3) / 2) * (x - (1 + / sqrt 3) / 2)) with
    (360 * (x * x - x) + 90 * (1 - / sqrt 3 * / sqrt 3)) by (set (s := / sqrt 3); field).
  rewrite square. field.
Qed.

Theorem S2_peak x : 0 <= x <= 1 -> Rabs (S2 x) <= 10 * / sqrt 3.
Proof.
  intros [low high]. destruct inverse_root as [square pos].
  apply Rabs_le.
  assert (bound : S2 x * S2 x <= (10 * / sqrt 3) * (10 * / sqrt 3)).
  { replace ((10 * / sqrt 3) * (10 * / sqrt 3)) with (100 * (/ sqrt 3 * / sqrt 3)) by ring.
    rewrite square. unfold S2. set (w := (1 - 2 * x) * (1 - 2 * x)).
    replace (60 * x * (1 - x) * (1 - 2 * x) * (60 * x * (1 - x) * (1 - 2 * x)))
      with (225 * (w * (1 - w) * (1 - w))) by (unfold w; ring).
    pose proof (pow2_ge_0 (1 - 2 * x)). assert (0 <= w <= 1) by (unfold w; split; nra).
    assert (0 <= (w - 1 / 3) ^ 2 * (4 / 3 - w)) by (apply Rmult_le_pos; [apply pow2_ge_0 | lra]).
    lra. }
  nra.
Qed.

(* SecondBound: where no peak is in [a, b], |S''| is largest at an end. *)
Theorem S2_between a b x : a <= x <= b -> ~ (a <= low_peak <= b) -> ~ (a <= high_peak <= b) ->
  Rabs (S2 x) <= Rmax (Rabs (S2 a)) (Rabs (S2 b)).
Proof.
  intros [ax xb] no_low no_high.
  assert (order : low_peak < high_peak)
    by (unfold low_peak, high_peak; destruct inverse_root; lra).
  assert (D : forall t, derivable_pt_lim S2 t (S3 t)) by exact S_third.
  assert (between : (S2 a <= S2 x <= S2 b) \/ (S2 b <= S2 x <= S2 a)).
  { assert (cases : (b < low_peak \/ high_peak < a) \/ (low_peak < a /\ b < high_peak)).
    { destruct (Rle_dec a low_peak), (Rle_dec low_peak b), (Rle_dec a high_peak),
        (Rle_dec high_peak b); try lra; exfalso; first [apply no_low; lra | apply no_high; lra]. }
    destruct cases as [outside | inside].
    - left. split; apply (rises S2 S3); auto; intros t Ht; rewrite S3_roots;
        destruct outside; nra.
    - right. split; apply (falls S2 S3); auto; intros t Ht; rewrite S3_roots; nra. }
  unfold Rabs, Rmax. repeat destruct Rcase_abs; repeat destruct Rle_dec; lra.
Qed.

(* ThirdRange: S''' is convex and least at ½, where it is −30. *)
Theorem S3_between a b x : a <= x <= b -> S3 x <= Rmax (S3 a) (S3 b) /\ -30 <= S3 x /\
  (~ (a <= 1 / 2 <= b) -> Rmin (S3 a) (S3 b) <= S3 x).
Proof.
  intros [ax xb]. unfold S3. pose proof (pow2_ge_0 (x - 1 / 2)). split; [ | split].
  - destruct (Req_dec a b) as [same | ne].
    + replace x with a by lra. apply Rmax_l.
    + assert (0 <= (x - a) * (b - x)) by (apply Rmult_le_pos; lra).
      unfold Rmax. destruct Rle_dec as [up | down].
      * assert (1 <= a + b) by nra. nra.
      * assert (a + b <= 1) by nra. nra.
  - nra.
  - intros no_half. assert (side : b < 1 / 2 \/ 1 / 2 < a).
    { destruct (Rlt_dec b (1 / 2)); [left; assumption | right].
      destruct (Rlt_dec (1 / 2) a); [assumption | exfalso; apply no_half; lra]. }
    destruct side.
    + eapply Rle_trans; [apply Rmin_r | nra].
    + eapply Rle_trans; [apply Rmin_l | nra].
Qed.

(* The foot's step of constant speed. *)
Section Ramped.
  Variable r : R.
  Hypothesis r_pos : 0 < r.
  Hypothesis r_half : r <= 1 / 2.

  Let a := 16 * r / (15 - 14 * r).
  Let v := 15 / (15 - 14 * r).

  Lemma ramp_numbers : 0 < a <= 1 /\ 1 < v <= 15 / 8.
  Proof.
    unfold a, v. assert (0 < 15 - 14 * r) by lra.
    repeat split.
    - apply Rdiv_lt_0_compat; lra.
    - apply (Rmult_le_reg_r (15 - 14 * r)); [assumption | ].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
    - apply (Rmult_lt_reg_r (15 - 14 * r)); [assumption | ].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
    - apply (Rmult_le_reg_r (15 - 14 * r)); [assumption | ].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
  Qed.

  (* Where the ramp ends, S stands at ½: value, slope and curvature meet those of the middle, and
     by reflection those of the last ramp. *)
  Theorem ramp_meets_middle :
    a * S (r / (2 * r)) = 1 / 2 + v * (r - 1 / 2) /\
    a * (S1 (r / (2 * r)) / (2 * r)) = v /\
    a * (S2 (r / (2 * r)) / (2 * r * (2 * r))) = 0.
  Proof.
    replace (r / (2 * r)) with (1 / 2) by (field; lra).
    unfold a, v, S, S1, S2. repeat split; field; lra.
  Qed.

  Theorem middle_meets_fall :
    1 - a * S ((1 - (1 - r)) / (2 * r)) = 1 / 2 + v * (1 - r - 1 / 2).
  Proof.
    replace ((1 - (1 - r)) / (2 * r)) with (1 / 2) by (field; lra).
    unfold a, v, S. field. lra.
  Qed.

  (* Its greatest speed over its mean is v; bound of its second derivative. *)
  Theorem ramp_speed x : 0 <= x <= r -> 0 <= a * (S1 (x / (2 * r)) / (2 * r)) <= v.
  Proof.
    intros [low high]. destruct ramp_numbers as [[a_pos _] _].
    assert (unit : 0 <= x / (2 * r) <= 1).
    { unfold Rdiv. assert (0 < / (2 * r)) by (apply Rinv_0_lt_compat; lra).
      assert (2 * r * / (2 * r) = 1) by (apply Rinv_r; lra). split; nra. }
    pose proof (S1_pos (x / (2 * r))). pose proof (S1_steepest _ unit) as steep.
    assert (0 < / (2 * r)) by (apply Rinv_0_lt_compat; lra).
    assert (top : a * (15 / 8 * / (2 * r)) = v) by (unfold a, v; field; lra).
    unfold Rdiv in *. split.
    - apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra].
    - rewrite <- top. apply Rmult_le_compat_l; [lra | ]. apply Rmult_le_compat_r; lra.
  Qed.

  Theorem ramp_curvature x : 0 <= x <= r ->
    Rabs (a * (S2 (x / (2 * r)) / (2 * r * (2 * r)))) <=
    a * (10 * / sqrt 3 / (2 * r * (2 * r))).
  Proof.
    intros [low high]. destruct ramp_numbers as [[a_pos _] _].
    assert (unit : 0 <= x / (2 * r) <= 1).
    { unfold Rdiv. assert (0 < / (2 * r)) by (apply Rinv_0_lt_compat; lra).
      assert (2 * r * / (2 * r) = 1) by (apply Rinv_r; lra). split; nra. }
    assert (0 < / (2 * r * (2 * r))) by (apply Rinv_0_lt_compat; nra).
    unfold Rdiv. rewrite !Rabs_mult. rewrite (Rabs_pos_eq a) by lra.
    rewrite (Rabs_pos_eq (/ (2 * r * (2 * r)))) by lra.
    apply Rmult_le_compat_l; [lra | ]. apply Rmult_le_compat_r; [lra | ].
    apply S2_peak. exact unit.
  Qed.
End Ramped.

(* S_½ = S. *)
Lemma ramp_half x : 16 * (1 / 2) / (15 - 14 * (1 / 2)) * S (x / (2 * (1 / 2))) = S x.
Proof. replace (x / (2 * (1 / 2))) with x by field. field. Qed.
