(* wpg/README.md, "Soles at different heights": "Balance" and the shadows; smoothing/README.md, "The
   robot's ZMP between instants": of soles at different heights; "Tubes": of the ZMP.
   C++: SoleShadows (wpg/motion/sole_shadows.cc), SupportPolygon::Margin
   (wpg/geometry/support_polygon.cc), RobotDynamics::Zmp and Tilt.
   Assumes f_z > 0, soles that are convex, and in least_over a polygon of distinct corners that
   turns left at each: PlanarHull's, but for edges below 1e-9 m, which count as rounding. *)
Require Import Reals Lra Lia Psatz Arith.
From Halfstep Require Import calculus.
Open Scope R_scope.

(* The floor's force (fx, fy, fz) and moment (nx, ny, ·) about O. The points about which it has no
   horizontal moment are a line along f: (Px z, Py z, z). *)
Section Balance.
  Variables nx ny fx fy fz hL hR : R.
  Hypothesis push : 0 < fz.
  Variables L R_ : R -> R -> Prop.  (* the soles, seen from above, at the heights hL and hR *)
  Hypothesis L_convex : forall k a b c d, 0 <= k <= 1 -> L a b -> L c d ->
    L ((1 - k) * a + k * c) ((1 - k) * b + k * d).
  Hypothesis R_convex : forall k a b c d, 0 <= k <= 1 -> R_ a b -> R_ c d ->
    R_ ((1 - k) * a + k * c) ((1 - k) * b + k * d).
  Hypothesis L_there : exists a b, L a b.
  Hypothesis R_there : exists a b, R_ a b.

  Definition Px z := (z * fx - ny) / fz.
  Definition Py z := (nx + z * fy) / fz.

  Lemma on_the_line x y z :
    nx - (y * fz - z * fy) = 0 /\ ny - (z * fx - x * fz) = 0 <-> x = Px z /\ y = Py z.
  Proof.
    unfold Px, Py. split.
    - intros [H K]. split; apply (Rmult_eq_reg_r fz); try lra; field_simplify; lra.
    - intros [-> ->]. split; field; lra.
  Qed.

  Definition in_soles x y z := (z = hL /\ L x y) \/ (z = hR /\ R_ x y).

  (* Pushing forces along f at n points of the soles: shares w ≥ 0 of f that add up to it, and
     together have the floor's horizontal moment. *)
  Definition balanced := exists n (w X Y Z : nat -> R),
    (forall i, (i < n)%nat -> 0 <= w i /\ in_soles (X i) (Y i) (Z i)) /\ sum n w = 1 /\
    sum n (fun i => Y i * (w i * fz) - Z i * (w i * fy)) = nx /\
    sum n (fun i => Z i * (w i * fx) - X i * (w i * fz)) = ny.

  (* Each point of the hull of the soles is (1 − λ)a + λb, of one point of each. *)
  Lemma gathered n (w X Y Z : nat -> R) :
    (forall i, (i < n)%nat -> 0 <= w i /\ in_soles (X i) (Y i) (Z i)) ->
    exists l r a b c d, 0 <= l /\ 0 <= r /\ L a b /\ R_ c d /\ sum n w = l + r /\
      sum n (fun i => w i * X i) = l * a + r * c /\ sum n (fun i => w i * Y i) = l * b + r * d /\
      sum n (fun i => w i * Z i) = l * hL + r * hR.
  Proof.
    induction n as [ | n IH]; intros each.
    - destruct L_there as [a [b Lab]], R_there as [c [d Rcd]].
      exists 0, 0, a, b, c, d. simpl. repeat split; try lra; assumption.
    - destruct IH as (l & r & a & b & c & d & l0 & r0 & Lab & Rcd & W & SX & SY & SZ);
        [intros i Hi; apply each; lia | ].
      destruct (each n) as [w0 at_sole]; [lia | ]. simpl. rewrite W, SX, SY, SZ.
      destruct (Req_dec (w n) 0) as [-> | some].
      + exists l, r, a, b, c, d. repeat split; try assumption; ring.
      + destruct at_sole as [[-> at_L] | [-> at_R]].
        * exists (l + w n), r, ((1 - w n / (l + w n)) * a + w n / (l + w n) * X n),
            ((1 - w n / (l + w n)) * b + w n / (l + w n) * Y n), c, d.
          assert (0 <= w n / (l + w n) <= 1).
          { assert (inv : 0 < / (l + w n)) by (apply Rinv_0_lt_compat; lra).
            assert (one : (l + w n) * / (l + w n) = 1) by (apply Rinv_r; lra).
            unfold Rdiv. split; nra. }
          repeat split; try lra; try (apply L_convex; assumption); try assumption; field; lra.
        * exists l, (r + w n), a, b, ((1 - w n / (r + w n)) * c + w n / (r + w n) * X n),
            ((1 - w n / (r + w n)) * d + w n / (r + w n) * Y n).
          assert (0 <= w n / (r + w n) <= 1).
          { assert (inv : 0 < / (r + w n)) by (apply Rinv_0_lt_compat; lra).
            assert (one : (r + w n) * / (r + w n) = 1) by (apply Rinv_r; lra).
            unfold Rdiv. split; nra. }
          repeat split; try lra; try (apply R_convex; assumption); try assumption; field; lra.
  Qed.

  (* The line meets the soles' hull in space. *)
  Definition line_meets_hull := exists k a b c d, 0 <= k <= 1 /\ L a b /\ R_ c d /\
    (1 - k) * a + k * c = Px ((1 - k) * hL + k * hR) /\
    (1 - k) * b + k * d = Py ((1 - k) * hL + k * hR).

  Theorem balance : balanced <-> line_meets_hull.
  Proof.
    split.
    - intros (n & w & X & Y & Z & each & W & MX & MY).
      destruct (gathered n w X Y Z each)
        as (l & r & a & b & c & d & l0 & r0 & Lab & Rcd & E & SX & SY & SZ).
      exists r, a, b, c, d. assert (l = 1 - r) by lra. subst l.
      rewrite <- SX, <- SY, <- SZ. split; [lra | ]. split; [exact Lab | ]. split; [exact Rcd | ].
      apply on_the_line. split.
      + rewrite <- MX.
        rewrite (sum_ext n (fun i => Y i * (w i * fz) - Z i * (w i * fy))
                   (fun i => fz * (w i * Y i) + - fy * (w i * Z i))) by (intros; ring).
        rewrite sum_plus, !sum_scal. ring.
      + rewrite <- MY.
        rewrite (sum_ext n (fun i => Z i * (w i * fx) - X i * (w i * fz))
                   (fun i => fx * (w i * Z i) + - fz * (w i * X i))) by (intros; ring).
        rewrite sum_plus, !sum_scal. ring.
    - intros (k & a & b & c & d & range & Lab & Rcd & EX & EY).
      exists 2%nat, (fun i => match i with O => 1 - k | _ => k end),
        (fun i => match i with O => a | _ => c end), (fun i => match i with O => b | _ => d end),
        (fun i => match i with O => hL | _ => hR end). split.
      + intros [ | i] _; unfold in_soles; split; try lra; [left | right]; auto.
      + destruct (on_the_line ((1 - k) * a + k * c) ((1 - k) * b + k * d)
                    ((1 - k) * hL + k * hR)) as [_ back].
        destruct (back (conj EX EY)) as [HX HY]. simpl. repeat split; lra.
  Qed.

  (* In any plane z0: P(z0) is in the hull of the shadows L + (z0 − hL)s and R + (z0 − hR)s. *)
  Definition in_shadows z0 := exists k a b c d, 0 <= k <= 1 /\ L a b /\ R_ c d /\
    Px z0 = (1 - k) * (a + (z0 - hL) * (fx / fz)) + k * (c + (z0 - hR) * (fx / fz)) /\
    Py z0 = (1 - k) * (b + (z0 - hL) * (fy / fz)) + k * (d + (z0 - hR) * (fy / fz)).

  Theorem shadows z0 : line_meets_hull <-> in_shadows z0.
  Proof.
    assert (px : forall z, Px z0 = Px z + (z0 - z) * (fx / fz)) by (intro; unfold Px; field; lra).
    assert (py : forall z, Py z0 = Py z + (z0 - z) * (fy / fz)) by (intro; unfold Py; field; lra).
    split; intros (k & a & b & c & d & range & Lab & Rcd & EX & EY); exists k, a, b, c, d;
      rewrite (px ((1 - k) * hL + k * hR)), (py ((1 - k) * hL + k * hR)) in *;
      (split; [exact range | split; [exact Lab | split; [exact Rcd | split; lra]]]).
  Qed.

  (* Along e a corner's shadow and P(z0) are as far apart as the corner and P of its own plane:
     another z0 moves both alike, and while the corner rests only P moves. *)
  Lemma seen_from_the_corner z0 h x y ex ey :
    ex * (Px z0 - (x + (z0 - h) * (fx / fz))) + ey * (Py z0 - (y + (z0 - h) * (fy / fz))) =
    ex * (Px h - x) + ey * (Py h - y).
  Proof. unfold Px, Py. field. lra. Qed.
End Balance.

(* The hull at the midpoint m: corners (X i, Y i), i counted modulo n, counter-clockwise. *)
Section Polygon.
  Variable n : nat.
  Hypothesis n_pos : (0 < n)%nat.
  Variables X Y : nat -> R.
  Hypothesis round : forall i, X (i + n)%nat = X i /\ Y (i + n)%nat = Y i.
  Let dx i := X (S i) - X i.
  Let dy i := Y (S i) - Y i.
  Hypothesis turns_left : forall i, 0 < dx i * dy (S i) - dy i * dx (S i).

  Let length i := sqrt (dx i * dx i + dy i * dy i).
  (* Inward unit normal of edge i, from corner i to corner i + 1. *)
  Definition normal_x i := - dy i / length i.
  Definition normal_y i := dx i / length i.

  Lemma length_pos i : 0 < length i.
  Proof.
    apply sqrt_lt_R0. pose proof (turns_left i). pose proof (pow2_ge_0 (dx i)).
    pose proof (pow2_ge_0 (dy i)). destruct (Req_dec (dx i) 0) as [e | ].
    - destruct (Req_dec (dy i) 0) as [e' | ]; [rewrite e, e' in *; lra | ].
      rewrite e. assert (0 < dy i * dy i) by nra. lra.
    - assert (0 < dx i * dx i) by nra. nra.
  Qed.

  Lemma normal_unit i : normal_x i * normal_x i + normal_y i * normal_y i = 1.
  Proof.
    pose proof (length_pos i) as pos. unfold normal_x, normal_y.
    replace (- dy i / length i * (- dy i / length i) + dx i / length i * (dx i / length i)) with
      ((dx i * dx i + dy i * dy i) / (length i * length i)) by (field; lra).
    unfold length at 1 2. rewrite sqrt_sqrt; [field | nra].
    unfold length in pos. intro z. rewrite z, sqrt_0 in pos. lra.
  Qed.

  (* Of the corners 1 … n one is lowest along e. *)
  Lemma lowest_corner ex ey : exists i, (0 < i)%nat /\
    forall j, ex * X i + ey * Y i <= ex * X j + ey * Y j.
  Proof.
    set (v j := ex * X j + ey * Y j).
    assert (first : forall m, exists i, (i <= m)%nat /\ forall j, (j <= m)%nat -> v i <= v j).
    { induction m as [ | m [i [le least]]].
      - exists O. split; [lia | ]. intros j Hj. replace j with O by lia. lra.
      - destruct (Rle_dec (v i) (v (S m))).
        + exists i. split; [lia | ]. intros j Hj. destruct (Nat.eq_dec j (S m)) as [-> | ];
            [assumption | apply least; lia].
        + exists (S m). split; [lia | ]. intros j Hj. destruct (Nat.eq_dec j (S m)) as [-> | ];
            [lra | ]. assert (v i <= v j) by (apply least; lia). lra. }
    assert (periodic : forall k j, v (j + k * n)%nat = v j).
    { induction k as [ | k IH]; intro j; simpl.
      - f_equal. lia.
      - replace (j + (n + k * n))%nat with ((j + k * n) + n)%nat by lia. unfold v.
        destruct (round (j + k * n)) as [-> ->]. apply IH. }
    destruct (first n) as [i [_ least]]. exists (i + n)%nat. split; [lia | ]. intro j.
    pose proof (periodic 1%nat i) as P. rewrite Nat.mul_1_l in P. fold (v (i + n)%nat) (v j).
    rewrite P. rewrite (Nat.div_mod j n) by lia. rewrite Nat.add_comm, Nat.mul_comm.
    rewrite periodic. apply least. pose proof (Nat.mod_upper_bound j n). lia.
  Qed.

  (* A unit vector e for which corner i is lowest is between the normals of its two edges:
     e = α e₁ + β e₂, α, β ≥ 0 and α + β ≥ 1. *)
  Lemma between_normals i ex ey : ex * ex + ey * ey = 1 ->
    ex * X (S i) + ey * Y (S i) <= ex * X i + ey * Y i ->
    ex * X (S i) + ey * Y (S i) <= ex * X (S (S i)) + ey * Y (S (S i)) ->
    exists al be, 0 <= al /\ 0 <= be /\ 1 <= al + be /\
      ex = al * normal_x i + be * normal_x (S i) /\ ey = al * normal_y i + be * normal_y (S i).
  Proof.
    intros unit low_before low_after. pose proof (turns_left i) as turn.
    pose proof (length_pos i) as p1. pose proof (length_pos (S i)) as p2.
    set (cross := dx i * dy (S i) - dy i * dx (S i)) in *.
    assert (after : 0 <= ex * dx (S i) + ey * dy (S i)) by (unfold dx, dy; lra).
    assert (before : ex * dx i + ey * dy i <= 0) by (unfold dx, dy; lra).
    assert (inv : 0 < / cross) by (apply Rinv_0_lt_compat; exact turn).
    set (al := length i * ((ex * dx (S i) + ey * dy (S i)) / cross)).
    set (be := length (S i) * (- (ex * dx i + ey * dy i) / cross)).
    assert (al0 : 0 <= al) by (unfold al, Rdiv; apply Rmult_le_pos; [lra | nra]).
    assert (be0 : 0 <= be) by (unfold be, Rdiv; apply Rmult_le_pos; [lra | nra]).
    assert (Ex : ex = al * normal_x i + be * normal_x (S i)).
    { unfold al, be, normal_x, cross. field. fold cross. lra. }
    assert (Ey : ey = al * normal_y i + be * normal_y (S i)).
    { unfold al, be, normal_y, cross. field. fold cross. lra. }
    exists al, be. repeat split; try assumption.
    (* ‖e‖ = 1 ≤ α + β. *)
    pose proof (normal_unit i) as u1. pose proof (normal_unit (S i)) as u2.
    set (a := normal_x i) in *. set (b := normal_y i) in *. set (c := normal_x (S i)) in *.
    set (d := normal_y (S i)) in *.
    assert (angle : a * c + b * d <= 1)
      by (pose proof (pow2_ge_0 (a - c)); pose proof (pow2_ge_0 (b - d)); lra).
    assert (1 <= (al + be) * (al + be)); [ | nra].
    rewrite <- unit. rewrite Ex, Ey.
    replace ((al * a + be * c) * (al * a + be * c) + (al * b + be * d) * (al * b + be * d)) with
      (al * al * (a * a + b * b) + be * be * (c * c + d * d) + 2 * (al * be) * (a * c + b * d))
      by ring.
    rewrite u1, u2. assert (0 <= al * be) by nra. nra.
  Qed.

  (* LeastOver. At t the corner i rests at its own height and sees the line's point at its height at
     (px i, py i). Where along the normals of both of its edges that is at least `least` inside,
     least ≥ 0, the line is `least` inside of the hull in every direction. *)
  Theorem least_over least (px py : nat -> R) : 0 <= least ->
    (forall i, least <= normal_x i * (px i - X i) + normal_y i * (py i - Y i)) ->
    (forall i, least <= normal_x i * (px (S i) - X (S i)) + normal_y i * (py (S i) - Y (S i))) ->
    forall ex ey, ex * ex + ey * ey = 1 ->
    exists i, least <= ex * (px i - X i) + ey * (py i - Y i).
  Proof.
    intros nonneg as_begin as_end ex ey unit.
    destruct (lowest_corner ex ey) as [[ | i] [pos low]]; [lia | ].
    destruct (between_normals i ex ey unit (low i) (low (S (S i))))
      as (al & be & a0 & b0 & one & Ex & Ey).
    exists (S i). pose proof (as_end i) as of_first. pose proof (as_begin (S i)) as of_second.
    rewrite Ex, Ey.
    set (u := px (S i) - X (S i)) in *. set (v := py (S i) - Y (S i)) in *.
    replace ((al * normal_x i + be * normal_x (S i)) * u +
             (al * normal_y i + be * normal_y (S i)) * v) with
      (al * (normal_x i * u + normal_y i * v) + be * (normal_x (S i) * u + normal_y (S i) * v))
      by ring.
    nra.
  Qed.
End Polygon.

(* Then SupportPolygon::Margin at t is no less: of an edge with the inward normal e, the corner from
   which it counts is no higher along e than any other corner of the hull. *)
Theorem margin_at_edge least ex ey px py ax ay bx by_ :
  ex * ax + ey * ay <= ex * bx + ey * by_ -> least <= ex * (px - bx) + ey * (py - by_) ->
  least <= ex * (px - ax) + ey * (py - ay).
Proof. intros. lra. Qed.

(* Tubes: h(n) the support function of the polygon P, h'(n) that of the soles where they are, whose
   corners are at most e away. A ZMP m inside P that moves by z is m − e − z inside the other. *)
Theorem zmp_in_a_tube h h' m e z np np' : h - e <= h' -> np <= h - m -> np' <= np + z ->
  np' <= h' - (m - e - z).
Proof. intros. lra. Qed.
