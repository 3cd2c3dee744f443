#!/usr/bin/env python3
"""PART 1: lumped-mass arms -> lumped.json   (python-flint ball arithmetic / exact rationals; all numbers certified)

* Inputs are rounded to doubles first, then taken as exact rationals.
* ei_a, ei_b, p, q, u, h, h_motor, h_torque: equations (2)-(5) solved directly for the 4n coefficients u_ij
  (fmpq_mat exact for n<=20, arb banded elimination with >1500 bits above), then (9), (8), (15):
  m_i yhat_i'' = 6(EI_i u_i3 - EI_{i+1} u_{i+1,3}) + [i=n] F_n,  C_t = -2 EI_1 u_12 + 6 EI_1 r u_13 (torque about the axis).
* Frequencies and zeros: exact characteristic polynomials in z=s^2.  n<=50: charpoly of -M^-1 K and adj(zI-A)b;
  all n>=30 also/instead polynomial transfer matrices (route not using K).  n=30,50: both routes, checked to agree.
  Roots isolated by acb_poly.roots, refined by Newton with certified radius (>110 bits).
  pinned/coupled (motor free, rotor inertia 0 / J): roots of Ct-numerator and of J z D + Ct-numerator without the rigid z=0.
  These and zeros_z, natural frequencies ignore damping.
* responses: direct solve of (K - w^2 M + j w C) y = K L and, independently, transfer matrices; checked to overlap.
  C_t also checked against sum L_i (m_i s^2 + c_i s) yhat_i.
"""
import sys, time, math
from common import *
random.seed(20240611)
LB, LBF, IN = 0.45359237, 4.4482216152605, 0.0254

def case(name, l, m, EI, r=0.0, c=None, J=None, dense=None, rsel=None, note=None, bits=1500):
    t0 = time.time()
    n = len(l)
    big = n >= 50
    dense = (not big) if dense is None else dense
    lq = [fq(x) for x in l]; mq = [fq(x) for x in m]; EIq = [fq(x) for x in EI]; rq = fq(r)
    Lq = []; s = rq
    for x in lq: s = s+x; Lq.append(s)
    if J is None: J = float("%.6g" % (10**random.uniform(-1.5, 0.5)*sum(float(a)*float(arb(b).mid())**2 for a, b in zip(m, Lq))))
    while True:
        ctx.prec = bits
        try:
            out = _case(name, l, m, EI, r, c, J, dense, note, n, lq, mq, EIq, rq, Lq, bits); break
        except (NeedPrec, ValueError, ZeroDivisionError) as e:
            bits *= 2
            print("  more bits", bits, str(e)[:60], flush=True)
            if bits > 60000: raise
    print(name, n, "bits", bits, "%.1fs" % (time.time()-t0), flush=True)
    return out

def _case(name, l, m, EI, r, c, J, dense, note, n, lq, mq, EIq, rq, Lq, bits):
    exact = n <= 20
    X = solve_direct(lq, EIq, exact)
    conv = (lambda x: x) if exact else (lambda x: arb(x))
    z0 = conv(fmpq(0))
    E = [conv(x) for x in EIq]; L = [conv(x) for x in Lq]
    u3 = [X[4*i+3] for i in range(n)]
    # force on mass i as function of [y_1..y_n, T_n]
    F = [[6*E[i]*u3[i][j] - (6*E[i+1]*u3[i+1][j] if i < n-1 else z0) for j in range(n+1)] for i in range(n)]
    Kx = [[-F[i][j] for j in range(n)] for i in range(n)]
    if exact: assert all(Kx[i][j] == Kx[j][i] for i in range(n) for j in range(n))
    ei_a = [[F[i][j]*L[j]/L[i] for j in range(n)] for i in range(n)]
    ei_b = [-sum((F[i][j]*L[j] for j in range(n)), z0)/L[i] for i in range(n)]
    p = [F[i][n]/L[i] for i in range(n)]
    ct = [-2*E[0]*X[2][j] + 6*E[0]*conv(rq)*X[3][j] for j in range(n+1)]
    h = [ct[j]*L[j] for j in range(n)]; hm = -sum(h, z0); ht = ct[n]
    o = dict(name=name, n=n, hub_radius_m=r, lengths_m=l, masses_kg=m, ei_n_m2=EI)
    if note: o["note"] = note
    if c: o["damping_n_s_per_m"] = c
    o["rotor_inertia_kg_m2"] = J
    if dense:
        o["ei_a"] = [[fl(x) for x in row] for row in ei_a]
    o["ei_b"] = [fl(x) for x in ei_b]
    o["p"] = [fl(x) for x in p]
    if dense:
        o["q"] = [0.0]*(n-1) + [fl(1/L[n-1])]
        o["u"] = [[fl(x) for x in row] for row in u3]
    o["h"] = [fl(x) for x in h]; o["h_motor"] = fl(hm); o["h_torque"] = fl(ht)
    # ---- polynomials
    La = [arb(x) for x in Lq]; ma = [arb(x) for x in mq]; la = [arb(x) for x in lq]; Ea = [arb(x) for x in EIq]; ra = arb(rq)
    K = arb_mat([[arb(x) for x in row] for row in Kx]); R = arb_mat([[x] for x in La])
    Mm = arb_mat([[ma[i] if i == j else arb(0) for j in range(n)] for i in range(n)])
    Minv = arb_mat([[1/ma[i] if i == j else arb(0) for j in range(n)] for i in range(n)])
    zi = list(range(n)) if n < 50 else sorted({0, n//2-1, n-1})
    polys = None
    if n <= 50:
        D, N = krylov_polys(Minv, K, R)
        ha = [arb(x) for x in h]
        Nc = [arb(hm)*D[k] + (sum((ha[i]/La[i]*N[i][k] for i in range(n)), arb(0)) if k < n else 0) for k in range(n+1)]
        polys = (D, Nc, {i: N[i] for i in zi})
    if n >= 20 or n <= 3:
        t = transfer_polys(la, Ea, ma, ra, zi)
        if polys:   # the two routes agree
            k = t[0][n]/polys[0][n]
            for a, b in [(t[0], polys[0]), (t[1], polys[1])] + [(t[2][i], polys[2][i]) for i in zi]:
                assert all(x.overlaps(y*k) for x, y in zip(a, b)), "routes differ"
        polys = t
    D, Nc, N = polys
    w = freqs(D)
    assert len(w) == n
    o["natural_frequencies_rad_s"] = [fl(x) for x in w]
    o["pinned_frequencies_rad_s"] = [fl(x) for x in freqs(Nc, 1)]
    Ja = arb(fq(J))
    o["coupled_frequencies_rad_s"] = [fl(x) for x in freqs([a+b for a, b in zip(Nc+[arb(0)], [arb(0)]+[Ja*x for x in D])], 1)]
    o["zeros_z"] = {}
    for i in zi:
        rt = sortz(roots_of(N[i])); assert len(rt) == n-1
        o["zeros_z"][str(i+1)] = [flc(x) for x in rt]
    # ---- damping
    C = None
    if c:
        ca = [arb(fq(x)) for x in c]
        C = arb_mat([[ca[i] if i == j else arb(0) for j in range(n)] for i in range(n)])
        Ds, Ns = krylov_polys(Minv, K, R, C)
        o["damped_poles_s"] = [flc(x) for x in sortz(roots_of(Ds))]
        nt = Ns[n-1]
        while nt[-1].contains(0): nt = nt[:-1]
        o["damped_zeros_s_tip"] = [flc(x) for x in sortz(roots_of(nt))]
        assert len(o["damped_zeros_s_tip"]) == 2*n-2
    # ---- responses
    om = omegas(w[0].mid(), w[min(20, n)-1].mid(), [float(x.mid()) for x in w])
    ri = list(range(n)) if n <= 5 else [n//2-1, n-1]
    o["omega_rad_s"] = om
    o["response_index"] = [i+1 for i in ri]
    o["response"] = []; o["ct"] = []
    for x in om:
        s = acb(0, arb(fq(x)))
        g = [ma[i]*s*s + (ca[i]*s if c else 0) for i in range(n)]
        y, ct_ = transfer_response(la, Ea, g, ra)
        chk = sum((La[i]*g[i]*y[i] for i in range(n)), acb(0)); assert chk.overlaps(ct_)
        if n <= 50:
            y2 = dyn_response(Mm, K, R, C, arb(fq(x)))
            assert all(a.overlaps(b) for a, b in zip(y, y2)), "response routes"
        o["response"].append([flc(y[i]/La[i]) for i in ri]); o["ct"].append(flc(ct_))
    return o

def lu(lo, dec): return float("%.6g" % (lo*10**(random.random()*dec)))

def main():
    which = sys.argv[1] if len(sys.argv) > 1 else "all"
    cases = []
    def add(*a, **k):
        cases.append(case(*a, **k))
    add("a_5_8", [5.0, 8.0], [1.0, 2.0], [1.7, 1.7], J=40.0)
    add("a_5_8_hub", [5.0, 8.0], [1.0, 2.0], [1.7, 1.7], r=1.5, J=40.0)
    Em = 30e6*LBF/(IN*IN); Jr = 0.005529*LBF*IN
    I1 = math.pi*(0.032*IN)**4/64; I2 = math.pi*(0.047*IN)**4/64
    add("b_report_one_mass", [7*IN], [0.121*LB], [Em*I1], J=Jr)
    add("b_report_two_mass", [6*IN, 6*IN], [0.121*LB]*2, [Em*I2]*2, J=Jr)
    for k in range(40):
        n = 1+k % 6
        l = [lu(0.1, 1) for _ in range(n)]; m = [lu(0.05, 1) for _ in range(n)]; EI = [lu(0.5, 1) for _ in range(n)]
        r = lu(0.02, 1) if (k//6) % 3 == 1 else 0.0
        c = None
        if (k//6) % 2 == 1:
            c = [float("%.4g" % (10**random.uniform(-2, 0)*math.sqrt(m[i]*EI[i]/sum(l)**3))) for i in range(n)]
        add("c_random_%02d" % k, l, m, EI, r=r, c=c)
    def rnd(n, dl, dm, dE): return [lu(0.1, dl) for _ in range(n)], [lu(0.05, dm) for _ in range(n)], [lu(0.5, dE) for _ in range(n)]
    add("d_random_20", *rnd(20, 1, 1, 1))
    add("d_random_50", *rnd(50, 1, 2, 2), r=0.2, bits=3000)
    add("g_stiffness_ratio_1e9", [0.3, 0.5, 0.2, 0.7, 0.4], [0.5, 0.2, 1.0, 0.3, 0.8], [1e9, 1.0, 1e9, 1.0, 1e9], note="EI ratio 1e9 between spans")
    add("g_lengths_1_1e-4", [1.0, 1e-4]*6, [lu(0.1, 1) for _ in range(12)], [lu(1, 1) for _ in range(12)], note="alternating lengths")
    add("g_masses_6_decades", [lu(0.1, 1) for _ in range(30)], [lu(1e-4, 6) for _ in range(30)], [lu(1, 1) for _ in range(30)], bits=3000)
    json.dump(dict(about="see make_lumped.py; SI units", cases=cases), open("lumped.json", "w"), separators=(",", ":"))
    print("partial written", flush=True)
    if which == "small": return
    add("e_uniform_200", [1/200]*200, [1/200]*200, [10.0]*200, bits=8000, note="uniform cantilever lumped; doubles 0.005 taken exactly")
    json.dump(dict(about="see make_lumped.py; SI units", cases=cases), open("lumped.json", "w"), separators=(",", ":"))
    add("f_random_200", *rnd(200, 1, 1, 1), bits=8000)
    json.dump(dict(about="see make_lumped.py; SI units", cases=cases), open("lumped.json", "w"), separators=(",", ":"))
if __name__ == "__main__": main()
