(* What the other files need of derivatives, clamped numbers and sums.
   No statement of a page. Assumes nothing but Coq's real numbers. *)
Require Import Reals Lra Lia.
Open Scope R_scope.

(* Derivatives of functions as they are written. *)

Lemma d_eq f x l l' : derivable_pt_lim f x l -> l = l' -> derivable_pt_lim f x l'.
Proof. intros H <-. exact H. Qed.

Lemma d_ext f g x l : (forall t, f t = g t) -> derivable_pt_lim f x l -> derivable_pt_lim g x l.
Proof.
  intros same H eps Heps. destruct (H eps Heps) as [delta Hd]. exists delta.
  intros h Hh small. rewrite <- !same. exact (Hd h Hh small).
Qed.

Lemma d_const c x : derivable_pt_lim (fun _ => c) x 0.
Proof. exact (derivable_pt_lim_const c x). Qed.

Lemma d_id x : derivable_pt_lim (fun t => t) x 1.
Proof. exact (derivable_pt_lim_id x). Qed.

Lemma d_plus f g x a b : derivable_pt_lim f x a -> derivable_pt_lim g x b ->
  derivable_pt_lim (fun t => f t + g t) x (a + b).
Proof. exact (derivable_pt_lim_plus f g x a b). Qed.

Lemma d_minus f g x a b : derivable_pt_lim f x a -> derivable_pt_lim g x b ->
  derivable_pt_lim (fun t => f t - g t) x (a - b).
Proof. exact (derivable_pt_lim_minus f g x a b). Qed.

Lemma d_opp f x a : derivable_pt_lim f x a -> derivable_pt_lim (fun t => - f t) x (- a).
Proof. exact (derivable_pt_lim_opp f x a). Qed.

Lemma d_mult f g x a b : derivable_pt_lim f x a -> derivable_pt_lim g x b ->
  derivable_pt_lim (fun t => f t * g t) x (a * g x + f x * b).
Proof. exact (derivable_pt_lim_mult f g x a b). Qed.

Lemma d_scal k f x a : derivable_pt_lim f x a -> derivable_pt_lim (fun t => k * f t) x (k * a).
Proof. exact (derivable_pt_lim_scal f k x a). Qed.

Lemma d_comp f g x a b : derivable_pt_lim g x b -> derivable_pt_lim f (g x) a ->
  derivable_pt_lim (fun t => f (g t)) x (a * b).
Proof. intros Hg Hf. exact (derivable_pt_lim_comp g f x b a Hg Hf). Qed.

Lemma d_exp k x : derivable_pt_lim (fun t => exp (k * t)) x (k * exp (k * x)).
Proof.
  eapply d_eq.
  - apply (d_comp exp (fun t => k * t)); [apply d_scal, d_id | apply derivable_pt_lim_exp].
  - ring.
Qed.

Lemma d_div f g x a b : derivable_pt_lim f x a -> derivable_pt_lim g x b -> g x <> 0 ->
  derivable_pt_lim (fun t => f t / g t) x ((a * g x - f x * b) / (g x * g x)).
Proof.
  intros Df Dg apart. eapply d_eq; [exact (derivable_pt_lim_div f g x a b Df Dg apart) | ].
  unfold Rsqr. field. exact apart.
Qed.

(* Polynomials in t, and in what is known to have a derivative. *)
Ltac derive := eapply d_eq;
  [repeat first [eassumption | apply d_const | apply d_id | apply d_exp | apply d_plus
                | apply d_minus | apply d_opp | apply d_mult] | cbv beta].

(* A function whose derivative is not negative between a and b does not fall. *)
Lemma rises f f' a b : a <= b -> (forall t, a <= t <= b -> derivable_pt_lim f t (f' t)) ->
  (forall t, a < t < b -> 0 <= f' t) -> f a <= f b.
Proof.
  intros [ab | ->] D pos; [ | apply Rle_refl].
  destruct (MVT_cor2 f f' a b ab D) as [t [eq inside]].
  specialize (pos t inside). nra.
Qed.

Lemma falls f f' a b : a <= b -> (forall t, a <= t <= b -> derivable_pt_lim f t (f' t)) ->
  (forall t, a < t < b -> f' t <= 0) -> f b <= f a.
Proof.
  intros [ab | ->] D neg; [ | apply Rle_refl].
  destruct (MVT_cor2 f f' a b ab D) as [t [eq inside]].
  specialize (neg t inside). nra.
Qed.

(* Functions that are equal near x have the same derivative there. *)
Lemma d_near f g x l r : 0 < r -> (forall t, Rabs (t - x) < r -> f t = g t) ->
  derivable_pt_lim f x l -> derivable_pt_lim g x l.
Proof.
  intros Hr same D eps Heps. destruct (D eps Heps) as [delta Hd].
  assert (pos : 0 < Rmin delta r) by (apply Rmin_pos; [apply cond_pos | exact Hr]).
  exists (mkposreal _ pos). simpl. intros h Hh small.
  assert (Rabs h < delta) by (eapply Rlt_le_trans; [exact small | apply Rmin_l]).
  assert (Rabs h < r) by (eapply Rlt_le_trans; [exact small | apply Rmin_r]).
  rewrite <- !same.
  - apply Hd; assumption.
  - replace (x - x) with 0 by ring. rewrite Rabs_R0. exact Hr.
  - replace (x + h - x) with h by ring. assumption.
Qed.

(* A number held within [0, 1], as std::clamp(x, 0.0, 1.0) does. *)
Definition clamp x := Rmax 0 (Rmin 1 x).

Ltac clamps := unfold clamp, Rmax, Rmin in *; repeat destruct Rle_dec; try lra.

Lemma clamp_range x : 0 <= clamp x <= 1.
Proof. clamps. Qed.

Lemma clamp_le x y : x <= y -> clamp x <= clamp y.
Proof. intros. clamps. Qed.

Lemma clamp_low x : x <= 0 -> clamp x = 0.
Proof. intros. clamps. Qed.

Lemma clamp_high x : 1 <= x -> clamp x = 1.
Proof. intros. clamps. Qed.

Lemma clamp_in x : 0 <= x <= 1 -> clamp x = x.
Proof. intros. clamps. Qed.

Lemma clamp_near x y : Rabs (clamp y - clamp x) <= Rabs (y - x).
Proof. unfold Rabs. repeat destruct Rcase_abs; clamps. Qed.

(* Where f is at rest, what follows f at a clamped time is at rest too. *)
Lemma d_rest f x : derivable_pt_lim f (clamp x) 0 -> derivable_pt_lim (fun t => f (clamp t)) x 0.
Proof.
  intros D eps Heps. destruct (D eps Heps) as [delta Hd]. exists delta. intros h Hh small.
  set (way := clamp (x + h) - clamp x).
  assert (Hway : Rabs way <= Rabs h).
  { unfold way. replace h with (x + h - x) at 2 by ring. apply clamp_near. }
  replace (clamp (x + h)) with (clamp x + way) by (unfold way; ring).
  rewrite Rminus_0_r. destruct (Req_dec way 0) as [-> | moved].
  { rewrite Rplus_0_r. replace ((f (clamp x) - f (clamp x)) / h) with 0 by (field; exact Hh).
    rewrite Rabs_R0. exact Heps. }
  assert (way_small : Rabs way < delta) by lra.
  specialize (Hd way moved way_small). rewrite Rminus_0_r in Hd.
  assert (Hpos : 0 < Rabs h) by (apply Rabs_pos_lt; exact Hh).
  assert (Wpos : 0 < Rabs way) by (apply Rabs_pos_lt; exact moved).
  unfold Rdiv in *. rewrite Rabs_mult, Rabs_inv in *.
  set (d := Rabs (f (clamp x + way) - f (clamp x))) in *.
  assert (d < eps * Rabs way).
  { apply (Rmult_lt_reg_r (/ Rabs way)); [apply Rinv_0_lt_compat; exact Wpos | ].
    rewrite Rmult_assoc, Rinv_r, Rmult_1_r by lra. exact Hd. }
  apply (Rmult_lt_reg_r (Rabs h)); [exact Hpos | ].
  rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. nra.
Qed.

(* A profile that rests at both ends, and is constant before and after, has its derivative
   everywhere: so it joins its constants. *)
Lemma d_clamped f f' x : (forall t, derivable_pt_lim f t (f' t)) -> f' 0 = 0 -> f' 1 = 0 ->
  derivable_pt_lim (fun t => f (clamp t)) x (f' (clamp x)).
Proof.
  intros D at0 at1.
  destruct (Rle_dec x 0) as [low | low].
  { eapply d_eq; [ | symmetry; rewrite clamp_low by exact low; exact at0]. apply d_rest.
    rewrite clamp_low by exact low. eapply d_eq; [apply D | exact at0]. }
  destruct (Rle_dec 1 x) as [high | high].
  { eapply d_eq; [ | symmetry; rewrite clamp_high by exact high; exact at1]. apply d_rest.
    rewrite clamp_high by exact high. eapply d_eq; [apply D | exact at1]. }
  rewrite (clamp_in x) by lra. apply (d_near f _ x _ (Rmin x (1 - x))).
  - apply Rmin_pos; lra.
  - intros t near. rewrite clamp_in; [reflexivity | ].
    pose proof (Rmin_l x (1 - x)). pose proof (Rmin_r x (1 - x)).
    apply Rabs_def2 in near. lra.
  - apply D.
Qed.

(* f(0) + … + f(n − 1). *)
Fixpoint sum (n : nat) (f : nat -> R) : R :=
  match n with O => 0 | S k => sum k f + f k end.

Lemma sum_ext n f g : (forall i, (i < n)%nat -> f i = g i) -> sum n f = sum n g.
Proof.
  induction n as [ | n IH]; intros same; simpl; [reflexivity | ].
  rewrite IH, same; [reflexivity | lia | intros; apply same; lia].
Qed.

Lemma sum_plus n f g : sum n (fun i => f i + g i) = sum n f + sum n g.
Proof. induction n as [ | n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma sum_scal n k f : sum n (fun i => k * f i) = k * sum n f.
Proof. induction n as [ | n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma sum_le n f g : (forall i, (i < n)%nat -> f i <= g i) -> sum n f <= sum n g.
Proof.
  induction n as [ | n IH]; intros le; simpl; [apply Rle_refl | ].
  apply Rplus_le_compat; [apply IH; intros; apply le; lia | apply le; lia].
Qed.

Lemma d_sum n (f : nat -> R -> R) f' x : (forall i, (i < n)%nat -> derivable_pt_lim (f i) x (f' i)) ->
  derivable_pt_lim (fun t => sum n (fun i => f i t)) x (sum n f').
Proof.
  induction n as [ | n IH]; intros D; simpl; [apply d_const | ].
  apply d_plus; [apply IH; intros; apply D; lia | apply D; lia].
Qed.
