(* smoothing/README.md, "Solids of the ground", "Interval" included.
   C++: SolidGap::Distance and LeastAfter (smoothing/margins/foot_solids.h).
   Assumes that the outline's planar distance s falls by at most `moved` and the gap g in height by at
   most `lifted`; PolygonDistance itself is not proved. *)
Require Import Reals Lra Psatz.
From Halfstep Require Import calculus.
Open Scope R_scope.

(* √(s² + g²) where both are > 0, and else the larger. *)
Definition distance s g :=
  if Rlt_dec 0 s then if Rlt_dec 0 g then sqrt (s * s + g * g) else Rmax s g else Rmax s g.

Lemma legs_below s g : 0 <= s -> 0 <= g -> s <= sqrt (s * s + g * g) /\ g <= sqrt (s * s + g * g).
Proof.
  intros. split.
  - rewrite <- (sqrt_square s) at 1 by assumption. apply sqrt_le_1_alt. nra.
  - rewrite <- (sqrt_square g) at 1 by assumption. apply sqrt_le_1_alt. nra.
Qed.

(* Distances fall together with s and g. *)
Theorem distance_monotone s g s' g' : s' <= s -> g' <= g -> distance s' g' <= distance s g.
Proof.
  intros less_s less_g. unfold distance.
  destruct (Rlt_dec 0 s) as [s0 | ns]; destruct (Rlt_dec 0 g) as [g0 | ng];
    destruct (Rlt_dec 0 s') as [s1 | ns']; destruct (Rlt_dec 0 g') as [g1 | ng'];
    try lra; try (apply Rmax_lub; [eapply Rle_trans; [exact less_s | apply Rmax_l]
                                  | eapply Rle_trans; [exact less_g | apply Rmax_r]]).
  - apply sqrt_le_1_alt. nra.
  - destruct (legs_below s g); try lra. apply Rmax_lub; lra.
  - destruct (legs_below s g); try lra. apply Rmax_lub; lra.
  - destruct (legs_below s g); try lra. apply Rmax_lub; lra.
Qed.

(* LeastAfter. *)
Corollary least_after s g s' g' moved lifted : s - moved <= s' -> g - lifted <= g' ->
  distance (s - moved) (g - lifted) <= distance s' g'.
Proof. apply distance_monotone. Qed.

(* Where ≥ 0 it is the distance: s and g are those of the nearest points seen from above, and along z,
   between which there is 0 where both overlap. *)
Theorem distance_of_products s g : 0 <= s \/ 0 <= g ->
  distance s g = sqrt (Rmax 0 s * Rmax 0 s + Rmax 0 g * Rmax 0 g).
Proof.
  intros outside. unfold distance.
  destruct (Rlt_dec 0 s) as [s0 | ns]; [destruct (Rlt_dec 0 g) as [g0 | ng] | ].
  - rewrite !Rmax_right by lra. reflexivity.
  - rewrite (Rmax_right 0 s), (Rmax_left 0 g), Rmax_left by lra.
    replace (s * s + 0 * 0) with (s * s) by ring. rewrite sqrt_square; lra.
  - rewrite (Rmax_left 0 s) by lra. destruct (Rle_dec 0 g).
    + rewrite !Rmax_right by lra. replace (0 * 0 + g * g) with (g * g) by ring.
      rewrite sqrt_square; lra.
    + rewrite (Rmax_left 0 g), Rmax_left by lra. replace (0 * 0 + 0 * 0) with (0 * 0) by ring.
      rewrite sqrt_square by lra. lra.
Qed.

(* Where t ≤ z, no point of the foot is nearer to the prism than the outline at the sole's height: a
   point of the foot is above a point of the outline. *)
Theorem foot_no_nearer dx dy z top bottom z' zp : top <= z -> z <= z' -> bottom <= zp <= top ->
  dx * dx + dy * dy + (z - Rmax bottom (Rmin top z)) * (z - Rmax bottom (Rmin top z)) <=
  dx * dx + dy * dy + (z' - zp) * (z' - zp).
Proof.
  intros over up inside. rewrite (Rmin_left top z) by lra. rewrite Rmax_right by lra. nra.
Qed.
