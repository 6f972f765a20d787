(* smoothing/README.md, "Natural bounds", "Order of starts and ends", "At most one foot in the air",
   "Rests" and "Band"; "Variables" of the overlap program.
   C++: NaturalBoundOf and NaturalBound::At (smoothing/walk/homotopy_parameters.cc),
   SuperposedWalk::UpdateStarts (smoothing/walk/superposed_walk.cc), HalfStepShape::t1 and t2
   (wpg/motion/half_step_shape.h), DoubleSupportMargin.
   Assumes durations > 0 and shifts 2δ in [0, 1]; overlaps may be below 0. Half-steps count from 0,
   so i is up where it is even. *)
Require Import Reals Lra Lia Psatz Arith.
From Halfstep Require Import calculus.
Open Scope R_scope.

Section Walk.
  Variables T shift overlap t : nat -> R.
  Hypothesis T_pos : forall i, 0 < T i.
  Hypothesis shift_range : forall i, 0 <= shift i <= 1.
  Hypothesis starts : forall i, t (S i) = t i + T i - overlap i.

  Definition t1 i := (1 / 2 - 1 / 2 * shift i) * T i.
  Definition t2 i := (1 / 2 + 1 / 2 * shift i) * T i.
  Definition ends i := t i + T i.

  (* NaturalBoundOf: up → down min(T − t2, t1), down → up min(T, T). *)
  Definition natural i := if Nat.even i then Rmin ((1 - (1 / 2 + 1 / 2 * shift i)) * T i) (t1 (S i))
                          else Rmin (1 * T i) (1 * T (S i)).
  Hypothesis within : forall i, overlap i <= natural i.

  Lemma times i : 0 <= t1 i <= T i / 2 /\ T i / 2 <= t2 i <= T i /\ T i - t2 i = t1 i /\
    t2 i - t1 i = shift i * T i.
  Proof. unfold t1, t2. pose proof (T_pos i). pose proof (shift_range i). repeat split; nra. Qed.

  Lemma up_down i : Nat.even i = true -> overlap i <= T i - t2 i /\ overlap i <= t1 (S i).
  Proof.
    intros even. pose proof (within i) as le. unfold natural in le. rewrite even in le.
    pose proof (Rmin_l ((1 - (1 / 2 + 1 / 2 * shift i)) * T i) (t1 (S i))).
    pose proof (Rmin_r ((1 - (1 / 2 + 1 / 2 * shift i)) * T i) (t1 (S i))).
    unfold t2. split; lra.
  Qed.

  (* Both bounds give Δ ≤ min(T_i, T_{i+1}). *)
  Theorem natural_bound_below_both i : overlap i <= T i /\ overlap i <= T (S i).
  Proof.
    destruct (Nat.even i) eqn:even.
    - destruct (up_down i even). pose proof (times i). pose proof (times (S i)).
      pose proof (T_pos i). pose proof (T_pos (S i)). lra.
    - pose proof (within i) as le. unfold natural in le. rewrite even in le.
      pose proof (Rmin_l (1 * T i) (1 * T (S i))). pose proof (Rmin_r (1 * T i) (1 * T (S i))). lra.
  Qed.

  Lemma next_start i : t i <= t (S i).
  Proof. rewrite starts. pose proof (natural_bound_below_both i). lra. Qed.

  Lemma next_end i : ends i <= ends (S i).
  Proof. unfold ends. rewrite starts. pose proof (natural_bound_below_both i). lra. Qed.

  Theorem starts_in_order i j : (i <= j)%nat -> t i <= t j.
  Proof.
    induction 1 as [ | j _ IH]; [apply Rle_refl | ]. pose proof (next_start j). lra.
  Qed.

  Theorem ends_in_order i j : (i <= j)%nat -> ends i <= ends j.
  Proof.
    induction 1 as [ | j _ IH]; [apply Rle_refl | ]. pose proof (next_end j). lra.
  Qed.

  (* Those under way are a contiguous range. *)
  Definition under_way i time := t i < time < ends i.
  Theorem under_way_is_contiguous i j k time : (i <= j)%nat -> (j <= k)%nat ->
    under_way i time -> under_way k time -> under_way j time.
  Proof.
    intros ij jk [_ ei] [sk _]. pose proof (ends_in_order i j ij). pose proof (starts_in_order j k jk).
    unfold under_way. lra.
  Qed.

  (* The foot of step j is in the air from lift_off to landing. *)
  Definition lift_off j := t (2 * j)%nat + t2 (2 * j).
  Definition landing j := t (S (2 * j)) + t1 (S (2 * j)).

  Lemma even_up j : Nat.even (2 * j) = true.
  Proof. rewrite Nat.even_mul. reflexivity. Qed.

  Lemma odd_down j : Nat.even (S (2 * j)) = false.
  Proof. rewrite Nat.even_succ, <- Nat.negb_even, even_up. reflexivity. Qed.

  Theorem lands_after_lift_off j : lift_off j <= landing j.
  Proof.
    unfold lift_off, landing. rewrite starts. destruct (up_down (2 * j) (even_up j)).
    pose proof (times (2 * j)). pose proof (times (S (2 * j))). lra.
  Qed.

  (* The next step lifts off later than this one lands by T_b − Δ_b + t2 − t1, which is at least
     |T_b − T_{b+1}|/2 and half of both shifts. *)
  Theorem stands_between j : let b := S (2 * j) in
    lift_off (S j) - landing j = T b - overlap b + t2 (S b) - t1 b /\
    Rabs (T b - T (S b)) / 2 + shift b * T b / 2 + shift (S b) * T (S b) / 2 <=
      lift_off (S j) - landing j.
  Proof.
    intros b. assert (next : (2 * S j = S b)%nat) by (unfold b; lia).
    assert (eq : lift_off (S j) - landing j = T b - overlap b + t2 (S b) - t1 b).
    { unfold lift_off, landing. rewrite next, starts. fold b. ring. }
    split; [exact eq | ]. rewrite eq. destruct (natural_bound_below_both b).
    unfold t1, t2. unfold Rabs. destruct Rcase_abs; lra.
  Qed.

  (* Any two steps, not only neighbours: at most one foot is in the air, and where every shift takes
     at least d, both feet stand for d between. *)
  Theorem at_most_one_foot_in_the_air j k d : (forall i, d <= shift i * T i) -> (j < k)%nat ->
    landing j + d <= lift_off k.
  Proof.
    intros least lt. induction lt as [ | k lt IH].
    - destruct (stands_between j) as [_ apart]. pose proof (least (S (2 * j))).
      pose proof (least (S (S (2 * j)))). pose proof (Rabs_pos (T (S (2 * j)) - T (S (S (2 * j))))).
      lra.
    - pose proof (lands_after_lift_off k). destruct (stands_between k) as [_ apart].
      pose proof (Rabs_pos (T (S (2 * k)) - T (S (S (2 * k))))).
      assert (pos : forall i, 0 <= shift i * T i).
      { intro i. pose proof (T_pos i). pose proof (shift_range i). nra. }
      pose proof (pos (S (2 * k))). pose proof (pos (S (S (2 * k)))). lra.
  Qed.

  (* Band: an up half-step a has ended when a + 3 begins, a down half-step when a + 4 begins; so at
     most four are under way at once. *)
  Theorem up_ends_before_third a : Nat.even a = true -> ends a <= t (S (S (S a))).
  Proof.
    intros even.
    assert (down : Nat.even (S a) = false)
      by (rewrite Nat.even_succ, <- Nat.negb_even, even; reflexivity).
    assert (up : Nat.even (S (S a)) = true) by (simpl; exact even).
    destruct (up_down a even) as [_ of_a]. destruct (up_down _ up) as [of_up _].
    pose proof (natural_bound_below_both (S a)) as [lower upper].
    pose proof (times (S a)). pose proof (times (S (S a))).
    unfold ends. rewrite !starts. lra.
  Qed.

  Theorem at_most_four_under_way i j time : (i + 4 <= j)%nat -> under_way i time ->
    ~ under_way j time.
  Proof.
    intros far [_ ei] [sj _]. destruct (Nat.even i) eqn:even.
    - pose proof (up_ends_before_third i even).
      assert (t (S (S (S i))) <= t j) by (apply starts_in_order; lia). lra.
    - assert (up : Nat.even (S i) = true)
        by (rewrite Nat.even_succ, <- Nat.negb_even, even; reflexivity).
      pose proof (up_ends_before_third (S i) up). pose proof (next_end i).
      assert (t (S (S (S (S i)))) <= t j) by (apply starts_in_order; lia). lra.
  Qed.
End Walk.

(* The variables' bound: B = (u + v)/2 − √((u − v)²/4 + ε²) ≤ min(u, v). *)
Theorem smooth_bound_below u v eps :
  (u + v) / 2 - sqrt ((u - v) * (u - v) / 4 + eps * eps) <= Rmin u v.
Proof.
  assert (half : Rabs ((u - v) / 2) <= sqrt ((u - v) * (u - v) / 4 + eps * eps)).
  { rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr. nra. }
  unfold Rmin, Rabs in *. destruct Rle_dec, Rcase_abs; lra.
Qed.
