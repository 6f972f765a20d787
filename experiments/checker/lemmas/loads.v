(* wpg/README.md, "What each foot carries" and "Soles at different heights", "Loads";
   smoothing/README.md, "Torques between instants": how λ drifts.
   C++: RightShare, FromSole, FootLoads::On, Couple, CoupleOfRise and ShareDrift
   (wpg/motion/foot_loads.cc). A wrench is (moment, force) about a point of the plane of reference.
   Assumes f_z > 0; of the share, that p is not inside both soles (d_L + d_R > 0). *)
Require Import Reals Lra Psatz.
From Halfstep Require Import calculus.
Open Scope R_scope.

(* RightShare: λ = d_L/(d_L + d_R) of distances that are 0 inside, a half where both are. *)
Definition pos x := Rmax x 0.
Definition share l r :=
  if Rlt_dec 0 (pos l + pos r) then pos l / (pos l + pos r) else 1 / 2.

Lemma pos_range x : 0 <= pos x /\ x <= pos x.
Proof. unfold pos, Rmax. destruct Rle_dec; lra. Qed.

Lemma pos_le x y : x <= y -> pos x <= pos y.
Proof. unfold pos, Rmax. repeat destruct Rle_dec; lra. Qed.

Theorem share_range l r : 0 <= share l r <= 1.
Proof.
  unfold share. destruct (pos_range l) as [L _]. destruct (pos_range r) as [R _].
  destruct Rlt_dec as [apart | ]; [ | lra].
  assert (inv : 0 < / (pos l + pos r)) by (apply Rinv_0_lt_compat; exact apart).
  assert (one : (pos l + pos r) * / (pos l + pos r) = 1) by (apply Rinv_r; lra).
  unfold Rdiv. split; nra.
Qed.

(* A foot whose sole has p inside carries all. *)
Theorem inside_right l r : 0 < l -> r <= 0 -> share l r = 1.
Proof.
  intros out inside. unfold share. replace (pos r) with 0 by (unfold pos; rewrite Rmax_right; lra).
  replace (pos l) with l by (unfold pos; rewrite Rmax_left; lra).
  destruct Rlt_dec; [field; lra | lra].
Qed.

Theorem inside_left l r : l <= 0 -> 0 < r -> share l r = 0.
Proof.
  intros inside out. unfold share. replace (pos l) with 0 by (unfold pos; rewrite Rmax_right; lra).
  destruct (pos_range r). destruct Rlt_dec; [field; lra | lra].
Qed.

(* ShareDrift: while distances change by at most w, shares stay within the two that it compares,
   as long as p does not come to be inside both soles. *)
Theorem share_between l r l' r' w : Rabs (l' - l) <= w -> Rabs (r' - r) <= w ->
  0 < pos l' + pos r' -> share (l - w) (r + w) <= share l' r' <= share (l + w) (r - w).
Proof.
  intros of_l of_r apart.
  assert (l - w <= l' <= l + w) by (unfold Rabs in of_l; destruct Rcase_abs in of_l; lra).
  assert (r - w <= r' <= r + w) by (unfold Rabs in of_r; destruct Rcase_abs in of_r; lra).
  assert (monotone : forall a b c d, 0 <= a <= c -> 0 <= d <= b -> 0 < a + b -> 0 < c + d ->
    a / (a + b) <= c / (c + d)).
  { intros a b c d ac db ab cd. apply (Rmult_le_reg_r ((a + b) * (c + d))); [nra | ].
    replace (a / (a + b) * ((a + b) * (c + d))) with (a * (c + d)) by (field; lra).
    replace (c / (c + d) * ((a + b) * (c + d))) with (c * (a + b)) by (field; lra). nra. }
  pose proof (pos_range l'). pose proof (pos_range r').
  pose proof (pos_le (l - w) l'). pose proof (pos_le l' (l + w)).
  pose proof (pos_le (r - w) r'). pose proof (pos_le r' (r + w)).
  pose proof (pos_range (l - w)). pose proof (pos_range (r - w)).
  pose proof (pos_range (l + w)). pose proof (pos_range (r + w)).
  split.
  - unfold share. destruct (Rlt_dec 0 (pos l' + pos r')); [ | lra].
    destruct Rlt_dec as [q | none]; [apply monotone; lra | ].
    (* Both below 0 in the worst case: then r' is inside, and the right foot has all. *)
    assert (Z : pos r' = 0) by lra. replace (pos l' / (pos l' + pos r')) with 1; [lra | ].
    rewrite Z. field. lra.
  - unfold share at 1. destruct (Rlt_dec 0 (pos l' + pos r')); [ | lra].
    unfold share. destruct Rlt_dec as [q | none]; [apply monotone; lra | ].
    assert (Z : pos l' = 0) by lra. rewrite Z. unfold Rdiv. lra.
Qed.

(* A slope of at most 1/(d_L + d_R): where p moves by w, both distances change by w at most (below),
   and λ by w/(d_L + d_R) at most, of either place. *)
Theorem share_slope l r l' r' w : 0 <= l -> 0 <= r -> 0 <= l' -> 0 <= r' ->
  0 < l + r -> 0 < l' + r' -> Rabs (l' - l) <= w -> Rabs (r' - r) <= w ->
  Rabs (l' / (l' + r') - l / (l + r)) <= w / (l + r).
Proof.
  intros l0 r0 l0' r0' apart apart' of_l of_r.
  assert (L : - w <= l' - l <= w) by (unfold Rabs in of_l; destruct Rcase_abs in of_l; lra).
  assert (R : - w <= r' - r <= w) by (unfold Rabs in of_r; destruct Rcase_abs in of_r; lra).
  replace (l' / (l' + r') - l / (l + r)) with
    (((l' - l) * r' - l' * (r' - r)) / ((l' + r') * (l + r))) by (field; lra).
  replace (w / (l + r)) with (w * (l' + r') / ((l' + r') * (l + r))) by (field; lra).
  assert (inv : 0 < / ((l' + r') * (l + r))) by (apply Rinv_0_lt_compat; nra).
  unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ _)) by lra.
  apply Rmult_le_compat_r; [lra | ]. apply Rabs_le. split; nra.
Qed.

(* The wrenches. n, f: the floor's moment about O and force; c_L, c_R: the soles' centres, at heights
   h_L and h_R above O's plane. A force f has no horizontal moment about (p, h) where
   n_x = p_y f_z − h f_y and n_y = h f_x − p_x f_z: that is how P(h) is defined. *)
Section Wrenches.
  Variables nx ny nz fx fy fz lx ly rx ry hL hR : R.
  Hypothesis push : 0 < fz.
  Variable lam : R.

  Definition Px h := (h * fx - ny) / fz.
  Definition Py h := (nx + h * fy) / fz.

  Lemma no_horizontal_moment h :
    nx - (Py h * fz - h * fy) = 0 /\ ny - (h * fx - Px h * fz) = 0.
  Proof. unfold Px, Py. split; field; lra. Qed.

  (* Couple and CoupleOfRise: λ(1 − λ)(f_z (c_R − c_L) − (h_R − h_L) f_t) × ẑ. *)
  Let Cx := lam * (1 - lam) * (fz * (ry - ly) - (hR - hL) * fy).
  Let Cy := - (lam * (1 - lam) * (fz * (rx - lx) - (hR - hL) * fx)).

  (* FootLoads::On: the right foot has λW + C, the left one (1 − λ)W − C. *)
  Definition right_nx := lam * nx + Cx.
  Definition right_ny := lam * ny + Cy.
  Definition left_nx := (1 - lam) * nx - Cx.
  Definition left_ny := (1 - lam) * ny - Cy.

  (* Together they are the floor's. Of forces and n_z that is plain: λ + (1 − λ) = 1. *)
  Theorem both_are_the_floors : right_nx + left_nx = nx /\ right_ny + left_ny = ny.
  Proof. unfold right_nx, left_nx, right_ny, left_ny. split; ring. Qed.

  (* e = (1 − λ)(P(h_L) − c_L) + λ(P(h_R) − c_R). *)
  Definition ex := (1 - lam) * (Px hL - lx) + lam * (Px hR - rx).
  Definition ey := (1 - lam) * (Py hL - ly) + lam * (Py hR - ry).

  (* Each foot's own ZMP, in the plane of its sole, is at the same e from its centre: about c_R + e
     the force λf has all of the right foot's horizontal moment, and (1 − λ)f about c_L + e. *)
  Theorem zmp_of_the_right_foot :
    right_nx = (ry + ey) * (lam * fz) - hR * (lam * fy) /\
    right_ny = hR * (lam * fx) - (rx + ex) * (lam * fz).
  Proof. unfold right_nx, right_ny, ex, ey, Cx, Cy, Px, Py. split; field; lra. Qed.

  Theorem zmp_of_the_left_foot :
    left_nx = (ly + ey) * ((1 - lam) * fz) - hL * ((1 - lam) * fy) /\
    left_ny = hL * ((1 - lam) * fx) - (lx + ex) * ((1 - lam) * fz).
  Proof. unfold left_nx, left_ny, ex, ey, Cx, Cy, Px, Py. split; field; lra. Qed.
End Wrenches.

(* On one level: the right foot's own ZMP is at p + (1 − λ)(c_R − c_L), the left one's at
   p − λ(c_R − c_L); both are p − (1 − λ)c_L − λc_R from their centres. *)
Theorem on_one_level ny fx fz lx rx lam h : 0 < fz ->
  let px := Px ny fx fz h in let e := ex ny fx fz lx rx h h lam in
  e = px - (1 - lam) * lx - lam * rx /\
  rx + e = px + (1 - lam) * (rx - lx) /\ lx + e = px - lam * (rx - lx).
Proof. intros push px e. unfold e, ex, px. repeat split; ring. Qed.

(* FromSole: with u and v how far p is beyond the rectangle's edges along x and y of the sole, the
   distance is the longer of both where neither is beyond, else that from the rectangle. *)
Definition from_sole u v :=
  if Rlt_dec 0 (Rmax u v) then sqrt (pos u * pos u + pos v * pos v) else Rmax u v.

Lemma root_triangle a b c d : 0 <= a -> 0 <= b -> 0 <= c -> 0 <= d ->
  sqrt ((a + c) * (a + c) + (b + d) * (b + d)) <= sqrt (a * a + b * b) + sqrt (c * c + d * d).
Proof.
  intros. assert (0 <= a * a + b * b) by nra. assert (0 <= c * c + d * d) by nra.
  pose proof (sqrt_pos (a * a + b * b)). pose proof (sqrt_pos (c * c + d * d)).
  pose proof (sqrt_sqrt (a * a + b * b) H3) as P. pose proof (sqrt_sqrt (c * c + d * d) H4) as Q.
  apply Rsqr_incr_0_var; [ | lra]. rewrite Rsqr_sqrt by nra. unfold Rsqr.
  set (p := sqrt (a * a + b * b)) in *. set (q := sqrt (c * c + d * d)) in *.
  enough (a * c + b * d <= p * q) by nra.
  apply Rsqr_incr_0_var; [ | nra]. unfold Rsqr.
  replace (p * q * (p * q)) with ((p * p) * (q * q)) by ring. rewrite P, Q.
  pose proof (pow2_ge_0 (a * d - b * c)). nra.
Qed.

Lemma side_below x y : x <= sqrt (x * x + y * y).
Proof.
  eapply Rle_trans; [apply Rle_abs | ]. rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt.
  unfold Rsqr. pose proof (pow2_ge_0 y). lra.
Qed.

(* As p moves by (x, y), the distance grows by no more than ‖(x, y)‖: so a ZMP that moves by w
   changes both distances by w at most, which ShareDrift takes. *)
Theorem from_sole_is_1_lipschitz u v u' v' :
  from_sole u' v' <= from_sole u v + sqrt ((u' - u) * (u' - u) + (v' - v) * (v' - v)).
Proof.
  set (way := sqrt _).
  assert (along_u : u' <= u + way /\ v' <= v + way).
  { pose proof (side_below (u' - u) (v' - v)). pose proof (side_below (v' - v) (u' - u)) as Q.
    rewrite Rplus_comm in Q. unfold way. lra. }
  assert (rooted : forall a b, Rmax a b <= sqrt (a * a + b * b)).
  { intros a b. apply Rmax_lub; [apply side_below | rewrite Rplus_comm; apply side_below]. }
  destruct (pos_range u) as [U0 U]. destruct (pos_range v) as [V0 V].
  assert (below : Rmax u v <= from_sole u v).
  { unfold from_sole. destruct Rlt_dec; [ | lra]. pose proof (rooted (pos u) (pos v)).
    assert (Rmax u v <= Rmax (pos u) (pos v)) by
      (apply Rmax_lub; [eapply Rle_trans; [exact U | apply Rmax_l]
                       | eapply Rle_trans; [exact V | apply Rmax_r]]). lra. }
  unfold from_sole at 1. destruct (Rlt_dec 0 (Rmax u' v')) as [out | inside].
  2: { pose proof (Rmax_l u v). pose proof (Rmax_r u v).
       assert (Rmax u' v' <= Rmax u v + way) by (apply Rmax_lub; lra). lra. }
  unfold from_sole. destruct (Rlt_dec 0 (Rmax u v)) as [out0 | in0].
  - assert (pu : pos u' <= pos u + Rabs (u' - u)) by
      (unfold pos, Rmax, Rabs; repeat destruct Rle_dec; destruct Rcase_abs; lra).
    assert (pv : pos v' <= pos v + Rabs (v' - v)) by
      (unfold pos, Rmax, Rabs; repeat destruct Rle_dec; destruct Rcase_abs; lra).
    eapply Rle_trans; [ | eapply Rle_trans;
      [apply (root_triangle (pos u) (pos v) (Rabs (u' - u)) (Rabs (v' - v))); auto using Rabs_pos | ]].
    + apply sqrt_le_1_alt. pose proof (pos_range u'). pose proof (pos_range v'). nra.
    + apply Rplus_le_compat_l. unfold way. right. f_equal.
      pose proof (Rsqr_abs (u' - u)) as E. pose proof (Rsqr_abs (v' - v)) as F. unfold Rsqr in E, F.
      lra.
  - (* From inside: −m is free room along both. *)
    assert (mu : u <= Rmax u v) by apply Rmax_l. assert (mv : v <= Rmax u v) by apply Rmax_r.
    set (k := Rmax u v) in *. assert (k0 : k <= 0) by lra.
    assert (wide : sqrt (pos u' * pos u' + pos v' * pos v') - k <= way); [ | lra].
    assert (root : forall a b s, 0 <= a -> 0 <= b -> 0 <= s ->
      sqrt (a * a + b * b) + s <= sqrt ((a + s) * (a + s) + (b + s) * (b + s))).
    { intros a b s A B Hs. pose proof (sqrt_pos (a * a + b * b)).
      assert (0 <= a * a + b * b) by nra. pose proof (sqrt_sqrt _ H0) as E.
      assert (sqrt (a * a + b * b) <= a + b).
      { rewrite <- (sqrt_square (a + b)) by lra. apply sqrt_le_1_alt. nra. }
      apply Rsqr_incr_0_var; [ | apply sqrt_pos]. rewrite Rsqr_sqrt by nra. unfold Rsqr. nra. }
    destruct (Rle_dec u' 0) as [nu | pu']; destruct (Rle_dec v' 0) as [nv | pv'].
    + exfalso. unfold Rmax in out. destruct Rle_dec; lra.
    + replace (pos u') with 0 by (unfold pos; rewrite Rmax_right; lra).
      replace (pos v') with v' by (unfold pos; rewrite Rmax_left; lra).
      replace (0 * 0 + v' * v') with (v' * v') by ring. rewrite sqrt_square by lra. lra.
    + replace (pos v') with 0 by (unfold pos; rewrite Rmax_right; lra).
      replace (pos u') with u' by (unfold pos; rewrite Rmax_left; lra).
      replace (u' * u' + 0 * 0) with (u' * u') by ring. rewrite sqrt_square by lra. lra.
    + replace (pos u') with u' by (unfold pos; rewrite Rmax_left; lra).
      replace (pos v') with v' by (unfold pos; rewrite Rmax_left; lra).
      eapply Rle_trans; [apply (root u' v' (- k)); lra | ]. unfold way. apply sqrt_le_1_alt. nra.
Qed.
