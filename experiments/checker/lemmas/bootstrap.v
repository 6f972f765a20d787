(* smoothing/README.md, "Motion bounds": the change over half an interval, "Bootstrap", "Leg length",
   and how a walk's margin is proved on an interval ("Certificates").
   C++: IntervalMotion::Change and RateChange (wpg/motion/motion_bounds.h), Bootstrap
   (wpg/robot/bootstrap.h), MotionBounds::BoundLeg's leg_length_change
   (wpg/motion/motion_bounds.cc).
   Assumes what the rates are: that formulas for joints bound them is not proved here. *)
Require Import Reals Lra Lia Psatz.
From Halfstep Require Import calculus.
Open Scope R_scope.

Section Change.
  Variables x x1 x2 : R -> R.
  Hypothesis D1 : forall t, derivable_pt_lim x t (x1 t).
  Variables m h sup : R.

  (* |x(t) − x(m)| ≤ h·sup|ẋ|. *)
  Theorem change_by_rate : (forall t, Rabs (t - m) <= h -> Rabs (x1 t) <= sup) ->
    forall t, Rabs (t - m) <= h -> Rabs (x t - x m) <= h * sup.
  Proof.
    intros bound t near. assert (h0 : 0 <= h) by (pose proof (Rabs_pos (t - m)); lra).
    assert (s0 : 0 <= sup).
    { eapply Rle_trans; [apply Rabs_pos | apply (bound m)].
      replace (m - m) with 0 by ring. rewrite Rabs_R0. exact h0. }
    destruct (Rtotal_order t m) as [lt | [-> | gt]].
    - destruct (MVT_cor2 x x1 t m lt (fun c _ => D1 c)) as [c [eq inside]].
      assert (Rabs (x1 c) <= sup)
        by (apply bound; unfold Rabs in *; repeat destruct Rcase_abs; lra).
      replace (x t - x m) with (- (x1 c * (m - t))) by lra. rewrite Rabs_Ropp, Rabs_mult.
      rewrite Rmult_comm. rewrite (Rabs_minus_sym m t).
      apply Rmult_le_compat; auto using Rabs_pos.
    - replace (x m - x m) with 0 by ring. rewrite Rabs_R0. nra.
    - destruct (MVT_cor2 x x1 m t gt (fun c _ => D1 c)) as [c [eq inside]].
      assert (Rabs (x1 c) <= sup)
        by (apply bound; unfold Rabs in *; repeat destruct Rcase_abs; lra).
      rewrite eq, Rabs_mult, Rmult_comm. apply Rmult_le_compat; auto using Rabs_pos.
  Qed.

  (* |x(t) − x(m)| ≤ h·|ẋ(m)| + ½h²·sup|ẍ|. *)
  Hypothesis D2 : forall t, derivable_pt_lim x1 t (x2 t).
  Theorem change_by_curvature : (forall t, Rabs (t - m) <= h -> Rabs (x2 t) <= sup) ->
    forall t, Rabs (t - m) <= h -> Rabs (x t - x m) <= h * (Rabs (x1 m) + 1 / 2 * h * sup).
  Proof.
    intros bound.
    (* Both signs of x, each towards later and earlier times. *)
    assert (up : forall s k, (s = 1 \/ s = -1) -> (k = 1 \/ k = -1) ->
      forall w, 0 <= w <= h -> s * (x (m + k * w) - x m) <= w * Rabs (x1 m) + 1 / 2 * w * w * sup).
    { intros s k Hs Hk w [w0 wh].
      assert (ks : k * k = 1) by (destruct Hk as [-> | ->]; ring).
      assert (at_k : forall v, Rabs (m + k * v - m) = Rabs v).
      { intro v. replace (m + k * v - m) with (k * v) by ring. rewrite Rabs_mult.
        destruct Hk as [-> | ->]; [rewrite Rabs_R1 | rewrite (Rabs_left (-1)) by lra]; ring. }
      assert (slope : forall v, 0 <= v <= h -> s * (k * x1 (m + k * v)) <= Rabs (x1 m) + v * sup).
      { intros v [v0 vh].
        assert (less : 0 * sup + Rabs (x1 m) - s * (k * x1 (m + k * 0)) <=
                       v * sup + Rabs (x1 m) - s * (k * x1 (m + k * v))).
        { apply (rises (fun v => v * sup + Rabs (x1 m) - s * (k * x1 (m + k * v)))
                   (fun v => sup - s * (k * k * x2 (m + k * v)))); [exact v0 | | ].
          - intros u _. eapply d_eq.
            + apply d_minus; [apply d_plus | ];
                [apply d_mult; [apply d_id | apply d_const] | apply d_const | ].
              apply d_scal, d_scal. apply (d_comp x1 (fun v => m + k * v)); [ | apply D2].
              apply d_plus; [apply d_const | apply d_scal, d_id].
            + cbv beta. ring.
          - intros u [u0 u1]. rewrite ks, Rmult_1_l.
            assert (B : Rabs (x2 (m + k * u)) <= sup) by (apply bound; rewrite at_k, Rabs_pos_eq; lra).
            destruct Hs as [-> | ->]; unfold Rabs in B; destruct Rcase_abs in B; lra. }
        replace (m + k * 0) with m in less by ring.
        assert (s * (k * x1 m) <= Rabs (x1 m)).
        { unfold Rabs. destruct Rcase_abs, Hs as [-> | ->], Hk as [-> | ->]; lra. }
        lra. }
      assert (less : 0 * Rabs (x1 m) + 1 / 2 * 0 * 0 * sup - s * (x (m + k * 0) - x m) <=
                     w * Rabs (x1 m) + 1 / 2 * w * w * sup - s * (x (m + k * w) - x m)).
      { apply (rises (fun w => w * Rabs (x1 m) + 1 / 2 * w * w * sup - s * (x (m + k * w) - x m))
                 (fun w => Rabs (x1 m) + w * sup - s * (k * x1 (m + k * w)))); [exact w0 | | ].
        - intros u _. eapply d_eq.
          + apply d_minus.
            * apply d_plus; [apply d_mult; [apply d_id | apply d_const] | ].
              apply d_mult; [ | apply d_const]. apply d_mult; [ | apply d_id].
              apply d_scal, d_id.
            * apply d_scal, d_minus; [ | apply d_const].
              apply (d_comp x (fun v => m + k * v)); [ | apply D1].
              apply d_plus; [apply d_const | apply d_scal, d_id].
          + cbv beta. ring_simplify. lra || field.
        - intros u [u0 u1]. assert (S : 0 <= u <= h) by lra. pose proof (slope u S). lra. }
      replace (m + k * 0) with m in less by ring. lra. }
    intros t near. assert (s0 : 0 <= sup).
    { eapply Rle_trans; [apply Rabs_pos | apply (bound m)].
      replace (m - m) with 0 by ring. rewrite Rabs_R0. pose proof (Rabs_pos (t - m)). lra. }
    assert (way : exists k w, (k = 1 \/ k = -1) /\ 0 <= w <= h /\ t = m + k * w).
    { destruct (Rle_dec m t).
      - exists 1, (t - m). rewrite Rabs_pos_eq in near by lra. repeat split; lra.
      - exists (-1), (m - t). rewrite Rabs_left in near by lra. repeat split; lra. }
    destruct way as (k & w & Hk & [w0 wh] & ->).
    pose proof (up 1 k (or_introl eq_refl) Hk w (conj w0 wh)).
    pose proof (up (-1) k (or_intror eq_refl) Hk w (conj w0 wh)).
    assert (w * Rabs (x1 m) <= h * Rabs (x1 m)) by (apply Rmult_le_compat_r; [apply Rabs_pos | lra]).
    assert (w * w * sup <= h * h * sup) by (apply Rmult_le_compat_r; [exact s0 | nra]).
    apply Rabs_le. lra.
  Qed.
End Change.

(* Bootstrap: quantities v_i ≥ 0 that are continuous, at m no more than start_i; as far as all are
   below `assumed`, v_i ≤ start_i + h·rate_i (what rates of that size let them be). Where that is
   strictly below what was assumed, it holds on the whole interval: going outwards from m, a first
   time at which one of them reached its assumption would have passed what is implied. *)
Section Bootstrap.
  Variable n : nat.
  Variable v : nat -> R -> R.
  Variables start rate assumed : nat -> R.
  Variable h : R.
  Hypothesis h_pos : 0 <= h.
  Hypothesis continuous : forall i w, (i < n)%nat -> 0 <= w <= h -> continuity_pt (v i) w.
  Hypothesis at_m : forall i, (i < n)%nat -> v i 0 <= start i.
  (* w is the distance |t − m|, towards one side. *)
  Hypothesis as_far_as : forall w, 0 <= w <= h ->
    (forall u, 0 <= u < w -> forall i, (i < n)%nat -> v i u <= assumed i) ->
    forall i, (i < n)%nat -> v i w <= start i + h * rate i.
  Hypothesis implied_less : forall i, (i < n)%nat -> start i + h * rate i < assumed i.

  (* Near a place where all are strictly below, all are. *)
  Lemma all_near w : 0 <= w <= h -> (forall i, (i < n)%nat -> v i w < assumed i) ->
    exists r, 0 < r /\ forall u, Rabs (u - w) < r -> forall i, (i < n)%nat -> v i u < assumed i.
  Proof.
    intros range below.
    assert (each : forall k, (k <= n)%nat -> exists r, 0 < r /\
      forall u, Rabs (u - w) < r -> forall i, (i < k)%nat -> v i u < assumed i).
    { induction k as [ | k IH]; intros le.
      - exists 1. split; [lra | ]. intros; lia.
      - destruct IH as [r [r0 near]]; [lia | ].
        assert (kn : (k < n)%nat) by lia.
        destruct (continuous k w kn range (assumed k - v k w)) as [a [a0 close]];
          [pose proof (below k kn); lra | ]. simpl in *. unfold R_dist in *.
        exists (Rmin r a). split; [apply Rmin_pos; lra | ]. intros u Hu i Hi.
        pose proof (Rmin_l r a). pose proof (Rmin_r r a).
        destruct (Nat.eq_dec i k) as [-> | ne]; [ | apply near; [lra | lia]].
        destruct (Req_dec u w) as [-> | moved]; [apply below; lia | ].
        assert (C : Rabs (v k u - v k w) < assumed k - v k w).
        { apply close. split; [split; [exact I | auto] | lra]. }
        apply Rabs_def2 in C. lra. }
    exact (each n (Nat.le_refl n)).
  Qed.

  Theorem bootstrap w : 0 <= w <= h -> forall i, (i < n)%nat -> v i w <= start i + h * rate i.
  Proof.
    (* The set of all c ≤ h up to which the assumption holds. *)
    set (E := fun c => 0 <= c <= h /\ forall u, 0 <= u < c -> forall i, (i < n)%nat ->
                v i u <= assumed i).
    assert (E0 : E 0) by (split; [lra | intros; lra]).
    destruct (completeness E) as [top [upper least]].
    { exists h. intros c [range _]. lra. }
    { exists 0. exact E0. }
    assert (top0 : 0 <= top) by (apply upper; exact E0).
    assert (toph : top <= h) by (apply least; intros c [range _]; lra).
    assert (Etop : E top).
    { split; [lra | ]. intros u [u0 ut] i Hi.
      destruct (Rle_dec (v i u) (assumed i)) as [ok | bad]; [exact ok | exfalso].
      assert (top <= u); [ | lra]. apply least. intros c [range holds].
      destruct (Rle_dec c u); [assumption | exfalso]. apply bad. apply holds; [lra | exact Hi]. }
    assert (full : top = h).
    { destruct (Req_dec top h) as [eq | ne]; [exact eq | exfalso].
      destruct Etop as [range holds]. assert (lt : top < h) by lra.
      destruct (all_near top range) as [r [r0 near]].
      { intros i Hi. pose proof (as_far_as top range holds i Hi).
        pose proof (implied_less i Hi). lra. }
      set (c := Rmin h (top + r / 2)).
      assert (c1 : top < c) by (unfold c, Rmin; destruct Rle_dec; lra).
      assert (c2 : c <= h) by apply Rmin_l. assert (c3 : c <= top + r / 2) by apply Rmin_r.
      assert (Ec : E c).
      { split; [lra | ]. intros u [u0 uc] i Hi. destruct (Rlt_dec u top) as [old | new].
        - apply holds; [lra | exact Hi].
        - left. apply near; [ | exact Hi]. rewrite Rabs_pos_eq; lra. }
      pose proof (upper c Ec). lra. }
    intros range i Hi. apply as_far_as; [exact range | | exact Hi].
    intros u [u0 uw] j Hj. destruct Etop as [_ holds]. apply holds; [lra | exact Hj].
  Qed.
End Bootstrap.

(* |‖w(t)‖ − ‖w(m)‖| ≤ 2δ/(‖w(m)‖ + √(‖w(m)‖² − 2δ)), where ½‖w‖² changes by at most δ. *)
Theorem leg_length at_m at_t delta : 0 < at_m -> 0 <= at_t ->
  Rabs (at_t * at_t / 2 - at_m * at_m / 2) <= delta ->
  Rabs (at_t - at_m) <= 2 * delta / (at_m + sqrt (Rmax 0 (at_m * at_m - 2 * delta))).
Proof.
  intros mpos tpos near.
  assert (d0 : 0 <= delta) by (pose proof (Rabs_pos (at_t * at_t / 2 - at_m * at_m / 2)); lra).
  set (least := sqrt (Rmax 0 (at_m * at_m - 2 * delta))).
  assert (l0 : 0 <= least) by apply sqrt_pos.
  assert (below : least <= at_t).
  { unfold least. rewrite <- (sqrt_square at_t) by exact tpos. apply sqrt_le_1_alt.
    apply Rmax_lub; [nra | ]. unfold Rabs in near. destruct Rcase_abs in near; lra. }
  apply (Rmult_le_reg_r (at_m + least)); [lra | ].
  replace (2 * delta / (at_m + least) * (at_m + least)) with (2 * delta) by (field; lra).
  assert (same : Rabs (at_t - at_m) * (at_t + at_m) = 2 * Rabs (at_t * at_t / 2 - at_m * at_m / 2)).
  { replace (at_t * at_t / 2 - at_m * at_m / 2) with ((at_t - at_m) * (at_t + at_m) * / 2) by field.
    rewrite !Rabs_mult, (Rabs_pos_eq (/ 2)), (Rabs_pos_eq (at_t + at_m)) by lra. field. }
  pose proof (Rabs_pos (at_t - at_m)). nra.
Qed.

(* A statement on an interval: where the margin at the midpoint exceeds what is demanded by the bound
   on its change, it holds for all times of the interval. *)
Theorem interval_holds (margin : R -> R) m h change demanded :
  (forall t, Rabs (t - m) <= h -> margin m - change <= margin t) -> demanded <= margin m - change ->
  forall t, Rabs (t - m) <= h -> demanded <= margin t.
Proof. intros bound enough t near. specialize (bound t near). lra. Qed.
