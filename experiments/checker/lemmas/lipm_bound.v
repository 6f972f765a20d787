(* smoothing/README.md, "A lower bound": "Setting off".
   C++: LeastShift (smoothing/methods/lipm_bound.cc).
   Assumes a CoM and ZMP of a LIPM along one direction u, from rest to rest, and how far the ZMP goes:
   H while both soles stand, until b; S until b + phi; M later. Of feet only that sum is proved. *)
Require Import Reals Lra Psatz.
From Halfstep Require Import calculus.
Open Scope R_scope.

Section SettingOff.
  Variables c c1 p : R -> R.
  Variables omega D b phi H S M : R.
  Hypothesis omega_pos : 0 < omega.
  Hypothesis D1 : forall t, 0 <= t <= D -> derivable_pt_lim c t (c1 t).
  Hypothesis D2 : forall t, 0 <= t <= D ->
    derivable_pt_lim c1 t (omega * omega * (c t - p t)).
  Hypothesis rest : c1 0 = 0 /\ c1 D = 0.
  Hypothesis times : 0 <= b /\ 0 <= phi /\ b + phi <= D.
  Hypothesis until_b : forall t, 0 <= t <= b -> p t <= H.
  Hypothesis flight : forall t, b <= t <= b + phi -> p t <= S.
  Hypothesis later : forall t, b + phi <= t <= D -> p t <= M.
  Hypothesis end_in : c D <= M.

  (* ξ = c + ċ/ω has ξ̇ = ω(ξ − p). *)
  Definition xi t := c t + c1 t / omega.

  Lemma xi_rate t : 0 <= t <= D -> derivable_pt_lim xi t (omega * (xi t - p t)).
  Proof.
    intros Ht. unfold xi. eapply d_eq.
    - apply d_plus; [apply D1; exact Ht | ].
      apply (d_ext (fun t => / omega * c1 t)); [intro u; field; lra | ].
      apply d_scal, D2. exact Ht.
    - field. lra.
  Qed.

  (* Where p ≤ K between s and t, e^{−ωt}(ξ − K) rises. *)
  Lemma stage K s t : 0 <= s -> s <= t -> t <= D -> (forall u, s <= u <= t -> p u <= K) ->
    exp (- omega * s) * (xi s - K) <= exp (- omega * t) * (xi t - K).
  Proof.
    intros s0 st tD below.
    apply (rises (fun t => exp (- omega * t) * (xi t - K))
             (fun t => exp (- omega * t) * (omega * (K - p t)))); [exact st | | ].
    - intros u Hu. eapply d_eq.
      + apply d_mult; [apply d_exp | apply d_minus; [apply xi_rate; lra | apply d_const]].
      + cbv beta. ring.
    - intros u Hu. apply Rmult_le_pos; [left; apply exp_pos | ].
      assert (I : s <= u <= t) by lra. pose proof (below u I). apply Rmult_le_pos; lra.
  Qed.

  Theorem setting_off : c 0 <= H * (1 - exp (- omega * b)) +
    S * (exp (- omega * b) - exp (- omega * (b + phi))) + M * exp (- omega * (b + phi)).
  Proof.
    destruct times as [b0 [f0 in_D]]. destruct rest as [r0 rD].
    pose proof (stage H 0 b (Rle_refl 0) b0) as one.
    pose proof (stage S b (b + phi) b0) as two. pose proof (stage M (b + phi) D) as three.
    assert (xi0 : xi 0 = c 0) by (unfold xi; rewrite r0; field; lra).
    assert (xiD : xi D = c D) by (unfold xi; rewrite rD; field; lra).
    rewrite xi0 in one. rewrite xiD in three. rewrite Rmult_0_r, exp_0 in one.
    assert (A : 1 * (c 0 - H) <= exp (- omega * b) * (xi b - H)) by (apply one; [lra | exact until_b]).
    assert (B : exp (- omega * b) * (xi b - S) <= exp (- omega * (b + phi)) * (xi (b + phi) - S))
      by (apply two; [lra | lra | exact flight]).
    assert (C : exp (- omega * (b + phi)) * (xi (b + phi) - M) <= exp (- omega * D) * (c D - M))
      by (apply three; [lra | lra | lra | exact later]).
    assert (E : exp (- omega * D) * (c D - M) <= 0).
    { pose proof (exp_pos (- omega * D)). nra. }
    lra.
  Qed.

  (* b ≥ ln[(H − S − (M − S) e^{−ωφ₁})/(H − u·c(0))]/ω for the shortest flight φ₁, since M ≥ S. The
     numerator is LeastShift's `lost`; where it is not positive nothing is claimed. *)
  Theorem least_shift phi1 : phi1 <= phi -> S <= M -> c 0 < H ->
    0 < H - S - (M - S) * exp (- omega * phi1) ->
    ln ((H - S - (M - S) * exp (- omega * phi1)) / (H - c 0)) / omega <= b.
  Proof.
    intros shorter SM need pos. set (lost := H - S - (M - S) * exp (- omega * phi1)) in *.
    pose proof setting_off as bound.
    replace (- omega * (b + phi)) with (- omega * b + - omega * phi) in bound by ring.
    rewrite exp_plus in bound.
    assert (less : exp (- omega * phi) <= exp (- omega * phi1)).
    { destruct shorter as [lt | eq].
      - left. apply exp_increasing. nra.
      - right. rewrite eq. reflexivity. }
    pose proof (exp_pos (- omega * b)) as E.
    assert (kept : exp (- omega * b) * lost <= H - c 0).
    { assert ((M - S) * exp (- omega * phi) <= (M - S) * exp (- omega * phi1)) by
        (apply Rmult_le_compat_l; lra).
      assert (exp (- omega * b) * lost <=
              exp (- omega * b) * (H - S - (M - S) * exp (- omega * phi)))
        by (apply Rmult_le_compat_l; [lra | unfold lost; lra]).
      lra. }
    assert (inverse : exp (omega * b) * exp (- omega * b) = 1).
    { rewrite <- exp_plus. replace (omega * b + - omega * b) with 0 by ring. apply exp_0. }
    pose proof (exp_pos (omega * b)) as E'.
    assert (ratio : lost / (H - c 0) <= exp (omega * b)).
    { apply (Rmult_le_reg_r (H - c 0)); [lra | ].
      replace (lost / (H - c 0) * (H - c 0)) with lost by (field; lra).
      assert (scaled : exp (omega * b) * (exp (- omega * b) * lost) <= exp (omega * b) * (H - c 0))
        by (apply Rmult_le_compat_l; lra).
      rewrite <- Rmult_assoc, inverse in scaled. lra. }
    assert (logs : ln (lost / (H - c 0)) <= omega * b).
    { rewrite <- (ln_exp (omega * b)). destruct ratio as [lt | eq].
      - left. apply ln_increasing; [apply Rdiv_lt_0_compat; lra | exact lt].
      - right. rewrite eq. reflexivity. }
    apply (Rmult_le_reg_r omega); [exact omega_pos | ].
    replace (ln (lost / (H - c 0)) / omega * omega) with (ln (lost / (H - c 0))) by (field; lra).
    lra.
  Qed.
End SettingOff.
