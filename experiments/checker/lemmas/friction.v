(* wpg/README.md, "Friction that is needed".
   C++: FootFriction::needed (wpg/motion/foot_friction.h).
   Assumes that p ± ρu lie in the support polygon, ρ > 0 and f_z > 0; ReachAlong is not proved. *)
Require Import Reals Lra Psatz.
From Halfstep Require Import calculus.
Open Scope R_scope.

Section TwoPoints.
  Variables fx fy fz nz rho ux uy : R.
  Hypothesis push : 0 < fz.
  Hypothesis rho_pos : 0 < rho.
  Hypothesis unit : ux * ux + uy * uy = 1.

  Definition norm x y := sqrt (x * x + y * y).
  Definition needed := (norm fx fy + Rabs nz / rho) / fz.

  (* At p + sign·ρu: half of the push and of the pull, and sign·n_z/(2ρ) across u. *)
  Definition px sign := fx / 2 - sign * (nz / (2 * rho)) * uy.
  Definition py sign := fy / 2 + sign * (nz / (2 * rho)) * ux.

  (* Together they have the floor's force, no horizontal moment about p, and the yaw moment n_z. *)
  Theorem same_wrench :
    px 1 + px (-1) = fx /\ py 1 + py (-1) = fy /\ fz / 2 + fz / 2 = fz /\
    rho * uy * (fz / 2) + - rho * uy * (fz / 2) = 0 /\
    - (rho * ux * (fz / 2)) - - rho * ux * (fz / 2) = 0 /\
    rho * ux * py 1 - rho * uy * px 1 + (- rho * ux * py (-1) - - rho * uy * px (-1)) = nz.
  Proof.
    unfold px, py. repeat split; try (field; lra).
    replace nz with (nz * (ux * ux + uy * uy)) at 5 by (rewrite unit; ring). field. lra.
  Qed.

  Lemma norm_triangle a b c d : norm (a + c) (b + d) <= norm a b + norm c d.
  Proof.
    assert (squares : forall x y, 0 <= x * x + y * y).
    { intros x y. pose proof (pow2_ge_0 x). pose proof (pow2_ge_0 y). lra. }
    unfold norm. pose proof (squares a b) as A. pose proof (squares c d) as C.
    pose proof (sqrt_pos (a * a + b * b)). pose proof (sqrt_pos (c * c + d * d)).
    pose proof (sqrt_sqrt _ A) as P. pose proof (sqrt_sqrt _ C) as Q.
    set (p := sqrt (a * a + b * b)) in *. set (q := sqrt (c * c + d * d)) in *.
    assert (inner : a * c + b * d <= p * q).
    { apply Rsqr_incr_0_var; [ | nra]. unfold Rsqr.
      replace (p * q * (p * q)) with ((p * p) * (q * q)) by ring. rewrite P, Q.
      pose proof (pow2_ge_0 (a * d - b * c)). lra. }
    apply Rsqr_incr_0_var; [ | lra]. rewrite Rsqr_sqrt.
    - unfold Rsqr. nra.
    - pose proof (pow2_ge_0 (a + c)). pose proof (pow2_ge_0 (b + d)). lra.
  Qed.

  Lemma norm_scaled k x y : norm (k * x) (k * y) = Rabs k * norm x y.
  Proof.
    unfold norm. replace (k * x * (k * x) + k * y * (k * y)) with ((k * k) * (x * x + y * y)) by ring.
    rewrite sqrt_mult_alt by (pose proof (pow2_ge_0 k); lra). f_equal. apply sqrt_Rsqr_abs.
  Qed.

  (* At both points a coefficient of `needed` suffices. *)
  Theorem coefficient_suffices sign : sign = 1 \/ sign = -1 ->
    norm (px sign) (py sign) <= needed * (fz / 2).
  Proof.
    intros Hs. unfold needed.
    replace ((norm fx fy + Rabs nz / rho) / fz * (fz / 2)) with
      (1 / 2 * norm fx fy + Rabs nz / (2 * rho)) by (field; lra).
    unfold px, py.
    replace (fx / 2 - sign * (nz / (2 * rho)) * uy) with
      (1 / 2 * fx + sign * (nz / (2 * rho)) * - uy) by (field; lra).
    replace (fy / 2 + sign * (nz / (2 * rho)) * ux) with
      (1 / 2 * fy + sign * (nz / (2 * rho)) * ux) by (field; lra).
    eapply Rle_trans; [apply norm_triangle | ]. rewrite !norm_scaled.
    rewrite (Rabs_pos_eq (1 / 2)) by lra. apply Rplus_le_compat_l.
    replace (norm (- uy) ux) with 1.
    - rewrite Rabs_mult. unfold Rdiv. rewrite Rabs_mult.
      rewrite (Rabs_pos_eq (/ (2 * rho))) by (left; apply Rinv_0_lt_compat; lra).
      assert (one : Rabs sign = 1).
      { destruct Hs as [-> | ->]; [apply Rabs_R1 | rewrite Rabs_left; lra]. }
      rewrite one. lra.
    - unfold norm. replace (- uy * - uy + ux * ux) with 1 by lra. symmetry. apply sqrt_1.
  Qed.
End TwoPoints.
