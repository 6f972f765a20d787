(* smoothing/README.md, "The foot never goes below the floor", "Between levels" and "Interval".
   C++: SuperposedWalk::LeastHeight (smoothing/walk/superposed_walk.cc), LiftWindow
   (wpg/motion/swing_profiles.cc), NaturalOverlapBound (smoothing/walk/homotopy_parameters.cc).
   Assumes the bounds of CheckParameters: lift shares in (0, 1], the via point no lower than the
   two footsteps, and for never_below the natural bound of the overlap. *)
Require Import Reals Lra Psatz.
From Halfstep Require Import calculus smoothstep.
Open Scope R_scope.

Section Step.
  (* The up half-step a begins at t_a, lasts T_a and lifts the foot from t2 on, so that rising has
     L_a = T_a − t2 of time and takes the share rho_a of that. The down half-step b begins at
     t_b = t_a + T_a − overlap, and its foot has landed L_b = t1_b later. *)
  Variables t_a T_a L_a L_b rho_a rho_b overlap : R.
  Hypothesis L_a_pos : 0 < L_a.
  Hypothesis L_b_pos : 0 < L_b.
  Hypothesis share_a : 0 < rho_a <= 1.
  Hypothesis share_b : 0 < rho_b <= 1.

  Let lift_off := t_a + (T_a - L_a).
  Let t_b := t_a + T_a - overlap.
  Let sinks := t_b + (1 - rho_b) * L_b.
  Let landing := t_b + L_b.

  (* The fractions of the rise that is done, and of the sinking that is still to come. *)
  Definition risen t := clamp ((t - lift_off) / (rho_a * L_a)).
  Definition left t := 1 - clamp ((t - sinks) / (rho_b * L_b)).

  Variables from via to : R.  (* heights of the two footsteps and the via point *)
  Hypothesis from_low : from <= via.
  Hypothesis to_low : to <= via.

  (* The superposed height: where it begins, and what both half-steps have added. *)
  Definition height t :=
    from + (via - from) * S (risen t) + (to - via) * S (clamp ((t - sinks) / (rho_b * L_b))).

  (* z = (1 − A − B) h_V + A h_a + B h_b with A = 1 − S(u_a), B = 1 − S(u_b). *)
  Lemma height_is_mean t :
    height t = via * (S (risen t) + S (left t) - 1) + from * (1 - S (risen t)) +
               to * (1 - S (left t)).
  Proof.
    unfold height, left. set (u := clamp ((t - sinks) / (rho_b * L_b))).
    pose proof (S_antisymmetric u). replace (S u) with (1 - S (1 - u)) by lra. ring.
  Qed.

  Lemma risen_range t : 0 <= risen t <= 1.
  Proof. apply clamp_range. Qed.

  Lemma left_range t : 0 <= left t <= 1.
  Proof. unfold left. pose proof (clamp_range ((t - sinks) / (rho_b * L_b))). lra. Qed.

  Lemma divided x w : 0 < w -> x / w * w = x.
  Proof. intros. field. lra. Qed.

  (* Within the natural bound the sinking that is done is never more than the rise that is done. *)
  Lemma fractions_add_up t : overlap <= L_a -> overlap <= L_b -> 1 <= risen t + left t.
  Proof.
    intros within_a within_b. unfold risen, left.
    enough (clamp ((t - sinks) / (rho_b * L_b)) <= clamp ((t - lift_off) / (rho_a * L_a))) by lra.
    assert (wa : 0 < rho_a * L_a) by nra. assert (wb : 0 < rho_b * L_b) by nra.
    pose proof (divided (t - sinks) _ wb) as Ey. pose proof (divided (t - lift_off) _ wa) as Ex.
    set (y := (t - sinks) / (rho_b * L_b)) in *. set (x := (t - lift_off) / (rho_a * L_a)) in *.
    destruct (Rle_dec y 0) as [before | begun].
    { rewrite (clamp_low y) by exact before. apply clamp_range. }
    destruct (Rle_dec 1 x) as [up | rising].
    { rewrite (clamp_high x) by exact up. apply clamp_range. }
    apply clamp_le. unfold sinks, lift_off, t_b in *.
    (* r is what remains of a. *)
    set (r := t_a + T_a - t) in *.
    assert (Ex' : x * (rho_a * L_a) = L_a - r) by (unfold r; lra).
    assert (Ey' : (1 - y) * (rho_b * L_b) = L_b - (overlap - r)) by (unfold r; lra).
    assert (r_low : 0 <= r) by nra.
    assert (r_high : r <= overlap) by nra.
    assert (p : L_a - r <= x * L_a) by nra.
    assert (q : L_b - (overlap - r) <= (1 - y) * L_b).
    { destruct (Rle_dec 0 (1 - y)); nra. }
    (* (1 − r/L_a) + (1 − (Δ − r)/L_b) ≥ 1, times L_a L_b. *)
    assert (r * L_b + (overlap - r) * L_a <= L_a * L_b).
    { destruct (Rle_dec L_a L_b); nra. }
    assert ((L_a - r) * L_b <= x * L_a * L_b) by (apply Rmult_le_compat_r; lra).
    assert ((L_b - (overlap - r)) * L_a <= (1 - y) * L_b * L_a) by (apply Rmult_le_compat_r; lra).
    apply (Rmult_le_reg_r (L_a * L_b)); nra.
  Qed.

  Theorem never_below t : overlap <= L_a -> overlap <= L_b -> Rmin from to <= height t.
  Proof.
    intros within_a within_b. pose proof (fractions_add_up t within_a within_b) as both.
    pose proof (risen_range t). pose proof (left_range t).
    assert (S (1 - left t) <= S (risen t)) by (apply S_increasing; lra).
    pose proof (S_antisymmetric (left t)). pose proof (S_range (risen t)) as A.
    pose proof (S_range (left t)) as B. rewrite height_is_mean.
    unfold Rmin. destruct Rle_dec; nra.
  Qed.

  (* On the floor: z = η h (S(u_a) + S(u_b) − 1) ≥ 0. *)
  Corollary never_below_the_floor t : from = 0 -> to = 0 -> overlap <= L_a -> overlap <= L_b ->
    height t = via * (S (risen t) + S (left t) - 1) /\ 0 <= height t.
  Proof.
    intros f0 t0 within_a within_b. split.
    - rewrite height_is_mean, f0, t0. ring.
    - pose proof (never_below t within_a within_b) as low. rewrite f0, t0 in low.
      rewrite Rmin_left in low; lra.
  Qed.

  (* LeastHeight over [begin, end]. *)
  Definition monotone begin end_ :=
    (1 - S (risen begin)) * from + (1 - S (left end_)) * to +
    via * (S (risen begin) + S (left end_) - 1).
  Definition steepest begin end_ :=
    Rmin from to + 15 / 8 * (via - Rmin from to) *
      Rmin 0 (Rmin (risen begin + left begin) (risen end_ + left end_) - 1).
  Definition least_height begin end_ := Rmax (monotone begin end_) (steepest begin end_).

  Lemma scaled_le x y w : 0 < w -> x <= y -> x / w <= y / w.
  Proof.
    intros. unfold Rdiv. apply Rmult_le_compat_r; [ | assumption].
    left. apply Rinv_0_lt_compat. assumption.
  Qed.

  Lemma risen_rises s t : s <= t -> risen s <= risen t.
  Proof. intros. apply clamp_le, scaled_le; [nra | lra]. Qed.

  Lemma left_falls s t : s <= t -> left t <= left s.
  Proof.
    intros. unfold left.
    enough (clamp ((s - sinks) / (rho_b * L_b)) <= clamp ((t - sinks) / (rho_b * L_b))) by lra.
    apply clamp_le, scaled_le; [nra | lra].
  Qed.

  Lemma monotone_holds begin end_ t : begin <= t <= end_ -> monotone begin end_ <= height t.
  Proof.
    intros [b e]. rewrite height_is_mean. unfold monotone.
    assert (S (risen begin) <= S (risen t)) by (apply S_increasing, risen_rises; exact b).
    assert (S (left end_) <= S (left t)) by (apply S_increasing, left_falls; exact e).
    nra.
  Qed.

  (* A clamped line is concave as long as it is not cut off below. *)
  Lemma clamped_line_concave p q k : 0 <= k <= 1 -> (0 <= p /\ 0 <= q) \/ (p <= 0 /\ q <= 0) ->
    (1 - k) * clamp p + k * clamp q <= clamp ((1 - k) * p + k * q).
  Proof.
    intros [k0 k1] [[Hp Hq] | [Hp Hq]].
    - destruct (Rle_dec 1 ((1 - k) * p + k * q)) as [top | low].
      + rewrite (clamp_high _ top). pose proof (clamp_range p). pose proof (clamp_range q). nra.
      + rewrite (clamp_in ((1 - k) * p + k * q)) by nra.
        assert (clamp p <= p) by clamps. assert (clamp q <= q) by clamps. nra.
    - rewrite (clamp_low p), (clamp_low q), clamp_low by nra. lra.
  Qed.

  Lemma at_share begin end_ t : begin <= t <= end_ ->
    exists k, 0 <= k <= 1 /\ t = (1 - k) * begin + k * end_.
  Proof.
    intros [b e]. destruct (Req_dec begin end_) as [eq | ne].
    - exists 0. split; lra.
    - exists ((t - begin) / (end_ - begin)). split.
      + assert (Hd : 0 < end_ - begin) by lra. pose proof (divided (t - begin) _ Hd).
        split; nra.
      + field. lra.
  Qed.

  Lemma line_at_share s e k c w : 0 < w ->
    ((1 - k) * s + k * e - c) / w = (1 - k) * ((s - c) / w) + k * ((e - c) / w).
  Proof. intros. field. lra. Qed.

  (* The precondition of LeastHeight: the flight neither begins nor ends inside. *)
  Theorem sum_least_at_an_end begin end_ t : begin <= t <= end_ ->
    lift_off <= begin \/ end_ <= lift_off -> end_ <= landing \/ landing <= begin ->
    Rmin (risen begin + left begin) (risen end_ + left end_) <= risen t + left t.
  Proof.
    intros inside off_edge land_edge. destruct (at_share begin end_ t inside) as [k [Hk ->]].
    assert (wa : 0 < rho_a * L_a) by nra. assert (wb : 0 < rho_b * L_b) by nra.
    assert (A : (1 - k) * risen begin + k * risen end_ <= risen ((1 - k) * begin + k * end_)).
    { unfold risen. rewrite (line_at_share _ _ _ _ _ wa). apply clamped_line_concave; [exact Hk | ].
      assert (inv : 0 < / (rho_a * L_a)) by (apply Rinv_0_lt_compat; exact wa).
      unfold Rdiv. destruct off_edge; [left | right]; split; nra. }
    assert (B : (1 - k) * left begin + k * left end_ <= left ((1 - k) * begin + k * end_)).
    { unfold left. rewrite (line_at_share _ _ _ _ _ wb).
      set (p := (begin - sinks) / (rho_b * L_b)). set (q := (end_ - sinks) / (rho_b * L_b)).
      pose proof (divided (begin - sinks) _ wb) as Ep. fold p in Ep.
      pose proof (divided (end_ - sinks) _ wb) as Eq. fold q in Eq.
      assert (mirrored : forall x, 1 - clamp x = clamp (1 - x)) by (intro x; clamps).
      rewrite !mirrored.
      replace (1 - ((1 - k) * p + k * q)) with ((1 - k) * (1 - p) + k * (1 - q)) by ring.
      apply clamped_line_concave; [exact Hk | ]. unfold landing, sinks in *.
      destruct land_edge; [left | right]; split; nra. }
    unfold Rmin. destruct Rle_dec; nra.
  Qed.

  Theorem least_height_holds begin end_ t : begin <= t <= end_ ->
    lift_off <= begin \/ end_ <= lift_off -> end_ <= landing \/ landing <= begin ->
    least_height begin end_ <= height t.
  Proof.
    intros inside off_edge land_edge. apply Rmax_lub; [apply monotone_holds; exact inside | ].
    pose proof (sum_least_at_an_end begin end_ t inside off_edge land_edge) as ends.
    unfold steepest. set (low := Rmin from to). set (u := Rmin _ (risen end_ + left end_)) in *.
    assert (low <= from) by apply Rmin_l. assert (low <= to) by apply Rmin_r.
    pose proof (risen_range t) as ra. pose proof (left_range t) as rb.
    pose proof (S_range _ ra) as A. pose proof (S_range _ rb) as B.
    pose proof (S_antisymmetric (left t)) as odd.
    assert (steep : 15 / 8 * Rmin 0 (u - 1) <= S (risen t) + S (left t) - 1).
    { destruct (Rle_dec (risen t) (1 - left t)).
      - pose proof (S_steepest (risen t) (1 - left t)).
        assert (Rmin 0 (u - 1) <= risen t + left t - 1).
        { eapply Rle_trans; [apply Rmin_r | lra]. }
        lra.
      - assert (S (1 - left t) <= S (risen t)) by (apply S_increasing; lra).
        pose proof (Rmin_l 0 (u - 1)). lra. }
    rewrite height_is_mean.
    assert (0 <= via - low) by lra.
    assert (15 / 8 * (via - low) * Rmin 0 (u - 1) <= (via - low) * (S (risen t) + S (left t) - 1))
      by nra.
    nra.
  Qed.

  (* Within the natural bound `steepest` is the lower footstep itself. *)
  Theorem least_height_within begin end_ : overlap <= L_a -> overlap <= L_b ->
    steepest begin end_ = Rmin from to.
  Proof.
    intros within_a within_b. unfold steepest.
    pose proof (fractions_add_up begin within_a within_b).
    pose proof (fractions_add_up end_ within_a within_b).
    rewrite (Rmin_left 0); [ring | ]. unfold Rmin. destruct Rle_dec; lra.
  Qed.
End Step.

(* The floor is met: at Δ = L_a = L_b and shares of 1, z = 0 while both are under way. *)
Theorem floor_is_met L via r : 0 < L -> 0 <= r <= L ->
  height 0 L L L 1 1 L 0 via 0 (L - r) = 0.
Proof.
  intros L_pos [low high]. unfold height, risen.
  replace ((L - r - (0 + (L - L))) / (1 * L)) with ((L - r) / L) by (field; lra).
  replace ((L - r - (0 + L - L + (1 - 1) * L)) / (1 * L)) with ((L - r) / L) by (field; lra).
  ring.
Qed.
