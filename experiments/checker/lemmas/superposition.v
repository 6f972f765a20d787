(* smoothing/README.md, "Superposition", "Prefix state", "Successors" 1 and "Stop branches" 1;
   wpg/README.md, "LIPM" and, of junctions, "Half-step" ("The ends are at rest").
   C++: SuperposedWalk::At, FirstActive, LastActive and StopBranch (smoothing/walk/superposed_walk.cc),
   AgreeUntil (smoothing/walk/splice.cc), HalfStepTracks::AddMotion.
   Assumes that starts and ends are in order (natural_bounds.v), that half-steps begin where the
   last one ends, and of each quantity of a half-step, constant before 0 and after T, that it has
   two derivatives everywhere: smoothstep.v has that of S. *)
Require Import Reals Lra Lia Psatz Arith.
From Halfstep Require Import calculus.
Open Scope R_scope.

Section Walk.
  (* Half-steps 0 … n; f i τ is a quantity of half-step i, constant before 0 and after T_i. *)
  Variable n : nat.
  Variable f : nat -> R -> R.
  Variables T t : nat -> R.
  Hypothesis before : forall i tau, tau <= 0 -> f i tau = f i 0.
  Hypothesis after : forall i tau, T i <= tau -> f i tau = f i (T i).
  Hypothesis joined : forall i, f i (T i) = f (S i) 0.

  Definition walk time := f 0%nat 0 + sum (S n) (fun i => f i (time - t i) - f i 0).

  (* What AddMotion adds for half-steps a … a + m. *)
  Definition under_way a m time :=
    f a 0 + sum (S m) (fun k => f (a + k)%nat (time - t (a + k)%nat) - f (a + k)%nat 0).

  Lemma sum_split p q g : sum (p + q) g = sum p g + sum q (fun k => g (p + k)%nat).
  Proof.
    induction q as [ | q IH]; simpl.
    - rewrite Nat.add_0_r. ring.
    - rewrite Nat.add_succ_r. simpl. rewrite IH. ring.
  Qed.

  Lemma telescopes a : f 0%nat 0 + sum a (fun i => f i (T i) - f i 0) = f a 0.
  Proof.
    induction a as [ | a IH]; simpl; [ring | ]. rewrite <- joined, <- IH. ring.
  Qed.

  (* Half-steps before a have ended and those after a + m have not begun: the range that FirstActive
     and LastActive find is all that counts. *)
  Theorem prefix_state a m time : (a + m <= n)%nat ->
    (forall i, (i < a)%nat -> T i <= time - t i) ->
    (forall i, (a + m < i)%nat -> (i <= n)%nat -> time - t i <= 0) ->
    walk time = under_way a m time.
  Proof.
    intros inside ended ahead. unfold walk, under_way.
    replace (S n) with (a + (S m + (n - (a + m))))%nat by lia.
    rewrite !sum_split. rewrite <- (telescopes a).
    rewrite (sum_ext a _ (fun i => f i (T i) - f i 0)) by
      (intros i Hi; rewrite after by (apply ended; exact Hi); reflexivity).
    rewrite (sum_ext (n - (a + m)) _ (fun _ => 0 * 0)) by
      (intros k Hk; rewrite before by (apply ahead; lia); ring).
    rewrite sum_scal. ring.
  Qed.

  (* Δ = 0: where t_{i+1} = t_i + T_i, the walk is half-step a while that is under way. *)
  Theorem without_overlaps_concatenation a time : (a <= n)%nat -> (forall i, 0 < T i) ->
    (forall i, t (S i) = t i + T i) -> t a <= time <= t a + T a -> walk time = f a (time - t a).
  Proof.
    intros Ha pos starts [low high].
    assert (order : forall i j, (i <= j)%nat -> t i <= t j).
    { intros i j. induction 1 as [ | j _ IH]; [lra | ]. rewrite starts. pose proof (pos j). lra. }
    rewrite (prefix_state a 0 time); [ | lia | | ].
    - unfold under_way. simpl. rewrite Nat.add_0_r. ring.
    - intros i Hi. pose proof (order (S i) a Hi) as le. rewrite starts in le. lra.
    - intros i Hi _. assert (le : t (S a) <= t i) by (apply order; lia). rewrite starts in le. lra.
  Qed.

  (* C²: derivatives of a walk are the sums of those of its half-steps. *)
  Section Derivatives.
    Variables f1 f2 : nat -> R -> R.
    Hypothesis D1 : forall i tau, derivable_pt_lim (f i) tau (f1 i tau).
    Hypothesis D2 : forall i tau, derivable_pt_lim (f1 i) tau (f2 i tau).
    Hypothesis C2 : forall i tau, continuity_pt (f2 i) tau.

    Definition walk1 time := sum (S n) (fun i => f1 i (time - t i)).
    Definition walk2 time := sum (S n) (fun i => f2 i (time - t i)).

    Lemma d_shift g g1 s time : derivable_pt_lim g (time - s) g1 ->
      derivable_pt_lim (fun x => g (x - s)) time g1.
    Proof.
      intros D. eapply d_eq; [apply (d_comp g (fun x => x - s)); [ | exact D] | ].
      - derive. reflexivity.
      - ring.
    Qed.

    Theorem walk_first time : derivable_pt_lim walk time (walk1 time).
    Proof.
      unfold walk, walk1. eapply d_eq.
      - apply d_plus; [apply d_const | ]. apply d_sum. intros i _.
        apply d_minus; [apply (d_shift (f i)), D1 | apply d_const].
      - cbv beta. rewrite Rplus_0_l. apply sum_ext. intros. ring.
    Qed.

    Theorem walk_second time : derivable_pt_lim walk1 time (walk2 time).
    Proof. apply d_sum. intros i _. apply (d_shift (f1 i)), D2. Qed.

    Theorem walk_second_is_continuous time : continuity_pt walk2 time.
    Proof.
      unfold walk2. induction (S n) as [ | k IH]; simpl.
      - apply continuity_pt_const. intros x y. reflexivity.
      - apply continuity_pt_plus; [exact IH | ].
        apply (continuity_pt_comp (fun x => x - t k) (f2 k)); [ | apply C2].
        apply derivable_continuous_pt. exists 1. derive. ring.
    Qed.
  End Derivatives.
End Walk.

(* Z is linear: where each half-step's pair satisfies c̈ = ω²(c − p), the superposed pair does,
   whatever the starts. Both begin at the same place. *)
Theorem superposed_pair_satisfies_the_lipm n (c p c2 : nat -> R -> R) t omega time :
  (forall i tau, c2 i tau = omega * omega * (c i tau - p i tau)) ->
  (forall i, c i 0 = p i 0) ->
  walk2 n t c2 time = omega * omega * (walk n c t time - walk n p t time).
Proof.
  intros lipm rest. unfold walk, walk2. rewrite rest.
  replace (omega * omega * (p 0%nat 0 + sum (S n) (fun i => c i (time - t i) - c i 0) -
    (p 0%nat 0 + sum (S n) (fun i => p i (time - t i) - p i 0)))) with
    (omega * omega * (sum (S n) (fun i => c i (time - t i) - c i 0) +
      -1 * sum (S n) (fun i => p i (time - t i) - p i 0))) by ring.
  rewrite <- sum_scal, <- sum_plus, <- sum_scal. apply sum_ext. intros i _.
  rewrite lipm, rest. ring.
Qed.

(* Only what has begun counts. Two walks with the same half-steps 0 … k, at the same t_i, are equal
   until the earlier of their next starts; the stop branch S_k is the walk with n = k. *)
Theorem agree_until n m k f g t s time : (k <= n)%nat -> (k <= m)%nat ->
  (forall i tau, tau <= 0 -> f i tau = f i 0) -> (forall i tau, tau <= 0 -> g i tau = g i 0) ->
  (forall i, (i <= k)%nat -> t i = s i /\ forall tau, f i tau = g i tau) ->
  (forall i, (k < i)%nat -> (i <= n)%nat -> time <= t i) ->
  (forall i, (k < i)%nat -> (i <= m)%nat -> time <= s i) ->
  walk n f t time = walk m g s time.
Proof.
  intros kn km rest_f rest_g same ahead_t ahead_s.
  assert (first : forall N F u, (k <= N)%nat -> (forall i tau, tau <= 0 -> F i tau = F i 0) ->
    (forall i, (k < i)%nat -> (i <= N)%nat -> time <= u i) -> walk N F u time = walk k F u time).
  { intros N F u le rest ahead. unfold walk. f_equal.
    replace (S N) with (S k + (N - k))%nat by lia. rewrite sum_split.
    rewrite (sum_ext (N - k) _ (fun _ => 0 * 0)).
    - rewrite sum_scal. ring.
    - intros i Hi. rewrite rest; [ring | ]. assert (time <= u (S k + i)%nat) by (apply ahead; lia).
      lra. }
  rewrite (first n f t), (first m g s); try assumption. unfold walk. f_equal.
  - apply same. lia.
  - apply sum_ext. intros i Hi. destruct (same i ltac:(lia)) as [-> eq]. rewrite !eq. reflexivity.
Qed.

Corollary stop_branch n k f t time : (k <= n)%nat ->
  (forall i tau, tau <= 0 -> f i tau = f i 0) ->
  (forall i, (k < i)%nat -> (i <= n)%nat -> time <= t i) -> walk n f t time = walk k f t time.
Proof.
  intros le rest ahead. apply (agree_until n k k); auto; lia.
Qed.

(* It ends at rest: when all have ended, the walk is where its last half-step ends. *)
Theorem ends_at_rest n f T t time : (forall i tau, T i <= tau -> f i tau = f i (T i)) ->
  (forall i, f i (T i) = f (S i) 0) -> (forall i, (i <= n)%nat -> T i <= time - t i) ->
  walk n f t time = f n (T n).
Proof.
  intros after joined ended. unfold walk.
  rewrite (sum_ext (S n) _ (fun i => f i (T i) - f i 0)).
  - rewrite (telescopes f T joined (S n)). symmetry. apply joined.
  - intros i Hi. rewrite after; [reflexivity | apply ended; lia].
Qed.
