(* wpg/README.md, "Rest to rest": "A flat top", "Antisymmetry", "Closed form" and
   "0 ≤ c ≤ 1, and |c − p| ≤ ½ + a".
   C++: RestToRest (wpg/motion/rest_to_rest.cc), PreBump and SolveLipm (wpg/motion/pre_bump.cc);
   ComSecondBound is θ²(½ + a).
   Assumes a solution c of c'' = θ²(c − p) on [0, ½] from rest with c(½) = ½: that numbers a and γ
   which give it exist follows from the determinant, of which nothing is proved. *)
Require Import Reals Lra Lia Psatz.
From Halfstep Require Import calculus smoothstep.
Open Scope R_scope.

(* The bumps: (4x(1 − x))³, flat-topped ones, and their mixtures are in [0, 1]. *)
Definition round_bump (x : R) := (4 * x * (1 - x)) ^ 3.
Definition flat_bump (r x : R) := S (clamp (x / r)) * S (clamp ((1 - x) / r)).

Lemma round_bump_range x : 0 <= x <= 1 -> 0 <= round_bump x <= 1.
Proof.
  intros [low high]. unfold round_bump. pose proof (pow2_ge_0 (2 * x - 1)).
  assert (unit : 0 <= 4 * x * (1 - x) <= 1) by (split; nra).
  set (y := 4 * x * (1 - x)) in *. split; [apply pow_le; lra | ].
  rewrite <- (pow1 3). apply pow_incr. lra.
Qed.

(* S(x/r) on [0, r], 1 on [r, 1 − r], S((1 − x)/r) on [1 − r, 1]. *)
Lemma flat_bump_pieces r x : 0 < r <= 1 / 2 -> 0 <= x <= 1 ->
  (x <= r -> flat_bump r x = S (x / r)) /\ (r <= x <= 1 - r -> flat_bump r x = 1) /\
  (1 - r <= x -> flat_bump r x = S ((1 - x) / r)).
Proof.
  intros [r0 r1] [low high]. assert (inv : 0 < / r) by (apply Rinv_0_lt_compat; exact r0).
  assert (one : r * / r = 1) by (apply Rinv_r; lra). unfold flat_bump, Rdiv.
  repeat split; intros.
  - rewrite (clamp_high ((1 - x) * / r)) by nra. rewrite S_1, clamp_in by (split; nra). ring.
  - rewrite !clamp_high by nra. rewrite S_1. ring.
  - rewrite (clamp_high (x * / r)) by nra. rewrite S_1, clamp_in by (split; nra). ring.
Qed.

Lemma flat_bump_range r x : 0 <= flat_bump r x <= 1.
Proof.
  unfold flat_bump. pose proof (S_range _ (clamp_range (x / r))).
  pose proof (S_range _ (clamp_range ((1 - x) / r))). split; nra.
Qed.

(* B and two derivatives are 0 at both ends, and |B''| ≤ 24: so p is C², by S_is_C2. *)
Definition round_bump1 (x : R) := 192 * (x * (1 - x)) * (x * (1 - x)) * (1 - 2 * x).
Definition round_bump2 (x : R) := 384 * (x * (1 - x)) * (1 - 5 * (x * (1 - x))).

Theorem round_bump_derivatives x : derivable_pt_lim round_bump x (round_bump1 x) /\
  derivable_pt_lim round_bump1 x (round_bump2 x).
Proof.
  split.
  - apply (d_ext (fun x => 64 * (x * (1 - x)) * (x * (1 - x)) * (x * (1 - x)))).
    + intro t. unfold round_bump. ring.
    + unfold round_bump1. derive. ring.
  - unfold round_bump1, round_bump2. derive. ring.
Qed.

Theorem round_bump_ends : round_bump 0 = 0 /\ round_bump 1 = 0 /\ round_bump1 0 = 0 /\
  round_bump1 1 = 0 /\ round_bump2 0 = 0 /\ round_bump2 1 = 0.
Proof. unfold round_bump, round_bump1, round_bump2. repeat split; ring. Qed.

Theorem round_bump_second x : 0 <= x <= 1 -> Rabs (round_bump2 x) <= 24.
Proof.
  intros [low high]. unfold round_bump2. pose proof (pow2_ge_0 (x - 1 / 2)).
  assert (0 <= x * (1 - x) <= 1 / 4) by (split; nra). set (u := x * (1 - x)) in *.
  apply Rabs_le. pose proof (pow2_ge_0 (u - 1 / 10)). split; nra.
Qed.

Lemma mixture_range w p q : 0 <= w <= 1 -> 0 <= p <= 1 -> 0 <= q <= 1 ->
  0 <= w * p + (1 - w) * q <= 1.
Proof. intros. split; nra. Qed.

(* The shift ½ + (15x − 10x³ + 3x⁵)/16 is S, as fast as the shift is long; its first half is convex. *)
Lemma shift_is_smoothstep x :
  1 / 2 + (15 * x - 10 * x ^ 3 + 3 * x ^ 5) / 16 = S ((x + 1) / 2).
Proof. unfold S. field. Qed.

Lemma shift_convex x : 0 <= x <= 1 / 2 -> 0 <= S2 x.
Proof. intros. unfold S2. assert (0 <= x * (1 - x)) by nra. nra. Qed.

(* c'' ≥ θ²c from rest at 0 never falls below 0, and rises; in the same way with ≤. *)
Section FromRest.
  Variables c c1 c2 : R -> R.
  Variables theta b : R.
  Hypothesis theta_pos : 0 < theta.
  Hypothesis b_pos : 0 <= b.
  Hypothesis D1 : forall t, 0 <= t <= b -> derivable_pt_lim c t (c1 t).
  Hypothesis D2 : forall t, 0 <= t <= b -> derivable_pt_lim c1 t (c2 t).
  Hypothesis begin_c : c 0 = 0.
  Hypothesis begin_c1 : c1 0 = 0.

  Lemma stays_above : (forall t, 0 <= t <= b -> theta * theta * c t <= c2 t) ->
    forall t, 0 <= t <= b -> 0 <= c t.
  Proof.
    intros pushed.
    (* u = c' + θc has u' ≥ θu, so u e^{−θt} rises; then c e^{θt} does. *)
    assert (u : forall t, 0 <= t <= b -> 0 <= c1 t + theta * c t).
    { intros t [t0 tb].
      assert (R : exp (- theta * 0) * (c1 0 + theta * c 0) <= exp (- theta * t) * (c1 t + theta * c t)).
      { apply (rises (fun t => exp (- theta * t) * (c1 t + theta * c t))
          (fun t => exp (- theta * t) * (c2 t - theta * theta * c t))); [exact t0 | | ].
        - intros s Hs. eapply d_eq.
          + apply d_mult; [apply d_exp | ]. apply d_plus; [apply D2; lra | apply d_scal, D1; lra].
          + cbv beta. ring.
        - intros s Hs. apply Rmult_le_pos; [left; apply exp_pos | ].
          assert (In : 0 <= s <= b) by lra. pose proof (pushed s In). lra. }
      rewrite begin_c, begin_c1 in R. pose proof (exp_pos (- theta * t)). nra. }
    intros t [t0 tb].
    assert (R : exp (theta * 0) * c 0 <= exp (theta * t) * c t).
    { apply (rises (fun t => exp (theta * t) * c t)
        (fun t => exp (theta * t) * (c1 t + theta * c t))); [exact t0 | | ].
      - intros s Hs. eapply d_eq; [apply d_mult; [apply d_exp | apply D1; lra] | ]. cbv beta. ring.
      - intros s Hs. apply Rmult_le_pos; [left; apply exp_pos | apply u; lra]. }
    rewrite begin_c in R. pose proof (exp_pos (theta * t)). nra.
  Qed.
End FromRest.

Section RestToRest.
  Variables theta a delta : R.
  Hypothesis theta_pos : 0 < theta.
  Hypothesis delta_range : 0 < delta < 1 / 2.
  Let first := 1 / 2 - delta.
  Variable bump : R -> R.  (* B(σ/σ₁) *)
  Hypothesis bump_range : forall s, 0 <= s <= first -> 0 <= bump s <= 1.

  (* The ZMP on [0, ½], and a CoM from rest with c(½) = ½. *)
  Variables c c1 p : R -> R.
  Hypothesis p_bump : forall s, 0 <= s <= first -> p s = - a * bump s.
  Hypothesis p_shift : forall s, first <= s <= 1 / 2 -> p s = S ((s - first) / (2 * delta)).
  Hypothesis D1 : forall s, 0 <= s <= 1 / 2 -> derivable_pt_lim c s (c1 s).
  Hypothesis D2 : forall s, 0 <= s <= 1 / 2 -> derivable_pt_lim c1 s (theta * theta * (c s - p s)).
  Hypothesis at_rest : c 0 = 0 /\ c1 0 = 0.
  Hypothesis middle : c (1 / 2) = 1 / 2.

  Lemma shift_unit s : first <= s <= 1 / 2 -> 0 <= (s - first) / (2 * delta) <= 1 / 2.
  Proof.
    intros [low high]. assert (inv : 0 < / (2 * delta)) by (apply Rinv_0_lt_compat; lra).
    assert (one : 2 * delta * / (2 * delta) = 1) by (apply Rinv_r; lra).
    unfold Rdiv, first in *. split; nra.
  Qed.

  Lemma shift_above s : first <= s <= 1 / 2 -> 0 <= p s.
  Proof.
    intros Hs. rewrite p_shift by exact Hs. apply S_range. pose proof (shift_unit s Hs). lra.
  Qed.

  Lemma first_pos : 0 < first < 1 / 2.
  Proof. unfold first. lra. Qed.

  (* With a ≤ 0 the CoM would never rise above 0. *)
  Theorem bump_is_positive : 0 < a.
  Proof.
    destruct (Rlt_dec 0 a) as [ok | bad]; [exact ok | exfalso].
    destruct at_rest as [r0 r1]. pose proof first_pos. assert (a_low : a <= 0) by lra.
    assert (low : 0 <= - c (1 / 2)); [ | lra].
    apply (stays_above (fun s => - c s) (fun s => - c1 s)
             (fun s => - (theta * theta * (c s - p s))) theta (1 / 2)); try lra.
    - intros s Hs. apply d_opp, D1. exact Hs.
    - intros s Hs. apply d_opp, D2. exact Hs.
    - intros s Hs. assert (above : 0 <= p s); [ | assert (0 <= theta * theta * p s) by
        (apply Rmult_le_pos; [nra | exact above]); lra].
      destruct (Rle_dec s first) as [le | gt].
      + assert (I : 0 <= s <= first) by lra. rewrite p_bump by exact I. pose proof (bump_range s I). nra.
      + apply shift_above. lra.
  Qed.

  (* On the bump p ≤ 0, so c ≥ 0 there. *)
  Lemma com_above_on_bump s : 0 <= s <= first -> 0 <= c s.
  Proof.
    intros Hs. destruct at_rest as [r0 r1]. pose proof first_pos. pose proof bump_is_positive.
    apply (stays_above c c1 (fun s => theta * theta * (c s - p s)) theta first); try lra.
    - intros t Ht. apply D1. lra.
    - intros t Ht. apply D2. lra.
    - intros t Ht. rewrite (p_bump t Ht). pose proof (bump_range t Ht).
      assert (0 <= theta * theta * (a * bump t)) by (apply Rmult_le_pos; nra). lra.
  Qed.

  (* On the shift d = c − p has d'' = θ²d − p'' ≤ θ²d, d(σ₁) ≥ 0 and d(½) = 0. With
     s(σ) = e^{θ(½ − σ)} − e^{−θ(½ − σ)} > 0, which has s'' = θ²s and s(½) = 0, d's − ds' falls to
     0 at ½, so d/s rises. *)
  Let q1 s := S1 ((s - first) / (2 * delta)) * (1 / (2 * delta)).
  Let q2 s := S2 ((s - first) / (2 * delta)) * (1 / (2 * delta)) * (1 / (2 * delta)).
  Let q s := S ((s - first) / (2 * delta)).

  Lemma d_inner s : derivable_pt_lim (fun s => (s - first) / (2 * delta)) s (1 / (2 * delta)).
  Proof.
    apply (d_ext (fun s => 1 / (2 * delta) * (s - first))).
    - intro t. field. lra.
    - eapply d_eq; [apply d_scal; apply d_minus; [apply d_id | apply d_const] | field; lra].
  Qed.

  Lemma q_first s : derivable_pt_lim q s (q1 s).
  Proof. apply (d_comp S); [apply d_inner | apply S_first]. Qed.

  Lemma q_second s : derivable_pt_lim q1 s (q2 s).
  Proof.
    eapply d_eq.
    - apply d_mult; [ | apply d_const]. apply (d_comp S1); [apply d_inner | apply S_second].
    - unfold q2. cbv beta. ring.
  Qed.

  Lemma com_above_zmp_on_shift s : first <= s <= 1 / 2 -> p s <= c s.
  Proof.
    intros Hs. pose proof first_pos as F. rewrite (p_shift s Hs). fold (q s).
    destruct (Req_dec s (1 / 2)) as [-> | ne].
    { rewrite middle. unfold q, first. replace ((1 / 2 - (1 / 2 - delta)) / (2 * delta)) with (1 / 2)
        by (field; lra). unfold S. lra. }
    set (w := fun s => exp (theta * (1 / 2) + - theta * s) - exp (- (theta * (1 / 2)) + theta * s)).
    set (w1 := fun s => - theta * (exp (theta * (1 / 2) + - theta * s) +
                                   exp (- (theta * (1 / 2)) + theta * s))).
    assert (De : forall k l t, derivable_pt_lim (fun t => exp (l + k * t)) t (k * exp (l + k * t))).
    { intros k l t. eapply d_eq.
      - apply (d_comp exp (fun t => l + k * t)); [ | apply derivable_pt_lim_exp].
        apply d_plus; [apply d_const | apply d_scal, d_id].
      - ring. }
    assert (W1 : forall t, derivable_pt_lim w t (w1 t)).
    { intro t. eapply d_eq; [apply d_minus; apply De | unfold w1; ring]. }
    assert (W2 : forall t, derivable_pt_lim w1 t (theta * theta * w t)).
    { intro t. eapply d_eq; [apply d_scal, d_plus; apply De | unfold w; ring]. }
    assert (w_end : w (1 / 2) = 0).
    { unfold w. replace (theta * (1 / 2) + - theta * (1 / 2)) with 0 by ring.
      replace (- (theta * (1 / 2)) + theta * (1 / 2)) with 0 by ring. ring. }
    assert (w_pos : forall t, t < 1 / 2 -> 0 < w t).
    { intros t Ht. unfold w.
      assert (exp (- (theta * (1 / 2)) + theta * t) < exp (theta * (1 / 2) + - theta * t))
        by (apply exp_increasing; nra). lra. }
    assert (cross : forall t, first <= t <= 1 / 2 -> 0 <= (c1 t - q1 t) * w t - (c t - q t) * w1 t).
    { intros t Ht.
      assert (R : (c1 (1 / 2) - q1 (1 / 2)) * w (1 / 2) - (c (1 / 2) - q (1 / 2)) * w1 (1 / 2) <=
                  (c1 t - q1 t) * w t - (c t - q t) * w1 t).
      { apply (falls (fun t => (c1 t - q1 t) * w t - (c t - q t) * w1 t)
                 (fun t => - q2 t * w t)); [lra | | ].
        - intros u Hu. assert (I : 0 <= u <= 1 / 2) by lra. assert (J : first <= u <= 1 / 2) by lra.
          eapply d_eq.
          + apply d_minus.
            * apply d_mult; [apply d_minus; [apply D2; exact I | apply q_second] | apply W1].
            * apply d_mult; [apply d_minus; [apply D1; exact I | apply q_first] | apply W2].
          + cbv beta. rewrite (p_shift u J). fold (q u). ring.
        - intros u Hu. assert (J : first <= u <= 1 / 2) by lra. pose proof (shift_unit u J).
          assert (0 < w u) by (apply w_pos; lra). assert (0 < 1 / (2 * delta)).
          { unfold Rdiv. rewrite Rmult_1_l. apply Rinv_0_lt_compat. lra. }
          assert (0 <= q2 u).
          { unfold q2. apply Rmult_le_pos; [apply Rmult_le_pos | ]; try lra. apply shift_convex. lra. }
          nra. }
      rewrite w_end, middle in R.
      assert (qm : q (1 / 2) = 1 / 2).
      { unfold q, first. replace ((1 / 2 - (1 / 2 - delta)) / (2 * delta)) with (1 / 2)
          by (field; lra). unfold S. lra. }
      rewrite qm in R. lra. }
    assert (R : (c first - q first) / w first <= (c s - q s) / w s).
    { apply (rises (fun t => (c t - q t) / w t)
        (fun t => ((c1 t - q1 t) * w t - (c t - q t) * w1 t) / (w t * w t))); [lra | | ].
      - intros t Ht. assert (wt : 0 < w t) by (apply w_pos; lra).
        apply (d_div (fun t => c t - q t)); [ | apply W1 | lra].
        apply d_minus; [apply D1; lra | apply q_first].
      - intros t Ht. assert (wt : 0 < w t) by (apply w_pos; lra).
        apply Rmult_le_pos; [apply cross; lra | ]. left. apply Rinv_0_lt_compat. nra. }
    assert (ws : 0 < w s) by (apply w_pos; lra). assert (wf : 0 < w first) by (apply w_pos; lra).
    assert (begin : 0 <= (c first - q first) / w first).
    { pose proof (Rinv_0_lt_compat _ wf). unfold Rdiv. apply Rmult_le_pos; [ | lra].
      unfold q. replace ((first - first) / (2 * delta)) with 0 by (field; lra). rewrite S_0.
      assert (0 <= c first) by (apply com_above_on_bump; lra). lra. }
    assert ((c s - q s) = (c s - q s) / w s * w s) by (field; lra). nra.
  Qed.

  (* So c'' ≥ 0 on [0, ½]: c is convex and rises there from 0 to ½. *)
  Lemma com_above_zmp s : 0 <= s <= 1 / 2 -> p s <= c s.
  Proof.
    intros Hs. destruct (Rle_dec s first) as [le | gt].
    - assert (I : 0 <= s <= first) by lra. pose proof (com_above_on_bump s I).
      rewrite (p_bump s I). pose proof (bump_range s I). pose proof bump_is_positive. nra.
    - apply com_above_zmp_on_shift. lra.
  Qed.

  Lemma com_slope s : 0 <= s <= 1 / 2 -> 0 <= c1 s.
  Proof.
    intros Hs. destruct at_rest as [_ r1]. rewrite <- r1.
    apply (rises c1 (fun s => theta * theta * (c s - p s))); [lra | | ].
    - intros t Ht. apply D2. lra.
    - intros t Ht. assert (I : 0 <= t <= 1 / 2) by lra. pose proof (com_above_zmp t I).
      pose proof (Rmult_lt_0_compat _ _ theta_pos theta_pos). nra.
  Qed.

  Lemma com_rises s t : 0 <= s -> s <= t -> t <= 1 / 2 -> c s <= c t.
  Proof.
    intros s0 st th. apply (rises c c1); [exact st | | ].
    - intros u Hu. apply D1. lra.
    - intros u Hu. apply com_slope. lra.
  Qed.

  Theorem com_in_half s : 0 <= s <= 1 / 2 -> 0 <= c s <= 1 / 2 /\ 0 <= c s - p s <= 1 / 2 + a.
  Proof.
    intros Hs. destruct at_rest as [r0 _]. pose proof (com_above_zmp s Hs).
    assert (low : c 0 <= c s) by (apply com_rises; lra).
    assert (high : c s <= c (1 / 2)) by (apply com_rises; lra).
    pose proof bump_is_positive. repeat split; try lra.
    destruct (Rle_dec s first) as [le | gt].
    - assert (I : 0 <= s <= first) by lra. rewrite (p_bump s I). pose proof (bump_range s I). nra.
    - assert (I : first <= s <= 1 / 2) by lra. pose proof (shift_above s I). lra.
  Qed.

  (* The other half is c(σ) = 1 − c(1 − σ), and p alike. *)
  Definition com s := if Rle_dec s (1 / 2) then c s else 1 - c (1 - s).
  Definition zmp s := if Rle_dec s (1 / 2) then p s else 1 - p (1 - s).

  Theorem com_range s : 0 <= s <= 1 -> 0 <= com s <= 1 /\ Rabs (com s - zmp s) <= 1 / 2 + a.
  Proof.
    intros Hs. unfold com, zmp. destruct Rle_dec.
    - assert (I : 0 <= s <= 1 / 2) by lra. destruct (com_in_half s I). split; [lra | ].
      rewrite Rabs_pos_eq; lra.
    - assert (I : 0 <= 1 - s <= 1 / 2) by lra. destruct (com_in_half (1 - s) I). split; [lra | ].
      rewrite Rabs_left1; lra.
  Qed.

  (* ComSecondBound. *)
  Corollary com_second_bound s : 0 <= s <= 1 ->
    Rabs (theta * theta * (com s - zmp s)) <= theta * theta * (1 / 2 + a).
  Proof.
    intros Hs. destruct (com_range s Hs) as [_ bound]. rewrite Rabs_mult.
    rewrite (Rabs_pos_eq (theta * theta)) by nra. apply Rmult_le_compat_l; [nra | exact bound].
  Qed.
End RestToRest.

(* What is reflected obeys the same equation: rest at the start is then rest at the end. *)
Theorem reflection c c1 c2 p theta s : derivable_pt_lim c (1 - s) (c1 (1 - s)) ->
  derivable_pt_lim c1 (1 - s) (c2 (1 - s)) -> c2 (1 - s) = theta * theta * (c (1 - s) - p (1 - s)) ->
  derivable_pt_lim (fun s => 1 - c (1 - s)) s (c1 (1 - s)) /\
  derivable_pt_lim (fun s => c1 (1 - s)) s (theta * theta * ((1 - c (1 - s)) - (1 - p (1 - s)))).
Proof.
  intros D E eq.
  assert (inner : derivable_pt_lim (fun s => 1 - s) s (-1)) by (derive; ring).
  split.
  - eapply d_eq; [apply d_minus; [apply d_const | apply (d_comp c); [exact inner | exact D]] | ring].
  - eapply d_eq; [apply (d_comp c1); [exact inner | exact E] | rewrite eq; ring].
Qed.

(* SolveLipm: with (k + 2)(k + 1) c_{k+2} = λ²(c_k − p_k) the series, cut off after x^{n+1}, misses
   c'' = λ²(c − p) by the two terms λ²(c_n x^n + c_{n+1} x^{n+1}) alone, where p_k = 0 from n on. *)
Theorem series_residual (co pk : nat -> R) lambda n x :
  (forall k, INR (k + 2) * INR (k + 1) * co (k + 2)%nat = lambda * lambda * (co k - pk k)) ->
  sum n (fun k => INR (k + 2) * INR (k + 1) * co (k + 2)%nat * x ^ k) -
    lambda * lambda * (sum (n + 2) (fun k => co k * x ^ k) - sum n (fun k => pk k * x ^ k)) =
  - (lambda * lambda * (co n * x ^ n + co (n + 1)%nat * x ^ (n + 1))).
Proof.
  intros rec. replace (n + 2)%nat with (Datatypes.S (Datatypes.S n)) by lia. simpl sum.
  replace (Datatypes.S n) with (n + 1)%nat by lia.
  rewrite (sum_ext n (fun k => INR (k + 2) * INR (k + 1) * co (k + 2)%nat * x ^ k)
             (fun k => lambda * lambda * (co k * x ^ k + -1 * (pk k * x ^ k))))
    by (intros; rewrite rec; ring).
  rewrite sum_scal, sum_plus, sum_scal, pow_add, pow_1. ring.
Qed.

(* That sum is the second derivative of the cut-off series. *)
Lemma d_series (co : nat -> R) n x :
  derivable_pt_lim (fun x => sum n (fun k => co k * x ^ k)) x
    (sum n (fun k => co k * (INR k * x ^ pred k))).
Proof. apply d_sum. intros k _. apply d_scal. apply derivable_pt_lim_pow. Qed.
