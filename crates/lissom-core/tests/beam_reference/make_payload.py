#!/usr/bin/env python3
"""PART 2 (payload.json) and PART 4 (damping.json): lumped arms, exact rational K from the direct solution of (2)-(5).

Payload: q = (yhat_1..yhat_n, psi), psi = absolute tip angle = y'(L_n)+theta_m.  Statics: F = -K0 y + P T_n,
tip slope phi = S y + s T_n (all from the solved u_ij; P = S^T checked exactly)  =>  potential 1/2 d^T Kc d with
d = q - R theta_m, R = (L_1..L_n, 1), Kc = [[K0+P S/s, -P/s], [-S/s, 1/s]].
Kinetic: sum m_i yhat_i'^2/2 + m_p (yhat_n'+e psi')^2/2 + I_p psi'^2/2.  C_t = R^T Kc (R theta_m - q) (torque about the axis).
If m_p e^2 = 0 and I_p = 0 the tip angle is massless and the arm is the n-mass arm with m_n + m_p.
Damping: (i) proportional: M q'' + alpha M q' + beta K (q'-R thm') + K (q - R thm) = 0,
  C_t = R^T [K (R thm - q) + beta K (R thm' - q')] = R^T (M q'' + alpha M q').
(ii) modal: q = R thm + Phi eta (M-orthonormal motor-clamped modes), eta_k'' + 2 zeta_k w_k eta_k' + w_k^2 eta_k = -phi_k^T M R thm'',
  C_t = R^T M q'' (rate of angular momentum of the masses, nothing else).
Responses by direct solve; polynomials/roots certified (see common.py).
"""
from common import *
random.seed(777)

def statics(l, EI, r):
    lq = [fq(x) for x in l]; E = [fq(x) for x in EI]; rq = fq(r); n = len(l)
    L = []; s = rq
    for x in lq: s = s+x; L.append(s)
    X = solve_direct(lq, E, True); z = fmpq(0)
    F = [[6*E[i]*X[4*i+3][j] - (6*E[i+1]*X[4*i+7][j] if i < n-1 else z) for j in range(n+1)] for i in range(n)]
    a = 4*(n-1); S = [X[a+1][j] + 2*X[a+2][j]*lq[-1] + 3*X[a+3][j]*lq[-1]**2 for j in range(n+1)]
    return L, F, S
def am(rows): return arb_mat([[arb(x) for x in r] for r in rows])

def system(l, m, EI, r, mp, Ip, e):
    n = len(l); L, F, S = statics(l, EI, r); z = fmpq(0)
    mq = [fq(x) for x in m]; mpq, Iq, eq = fq(mp), fq(Ip), fq(e)
    K0 = [[-F[i][j] for j in range(n)] for i in range(n)]
    if Iq == 0 and mpq*eq == 0:
        mq[-1] += mpq
        return n, L, L, K0, [[mq[i] if i == j else z for j in range(n)] for i in range(n)]
    P = [F[i][n] for i in range(n)]; s = S[n]
    assert all(P[i] == S[i] for i in range(n)), "reciprocity"
    N = n+1
    K = [[K0[i][j] + P[i]*S[j]/s for j in range(n)] + [-P[i]/s] for i in range(n)] + [[-S[j]/s for j in range(n)] + [1/s]]
    assert all(K[i][j] == K[j][i] for i in range(N) for j in range(N))
    M = [[mq[i] if i == j and i < n else z for j in range(N)] for i in range(N)]
    M[n-1][n-1] += mpq; M[n-1][n] = M[n][n-1] = mpq*eq; M[n][n] = mpq*eq*eq + Iq
    return N, L, L+[fmpq(1)], K, M

def modal(Kx, Mx, Rx, J):
    K, M, R = am(Kx), am(Mx), am([[x] for x in Rx]); N = K.nrows(); Minv = M.inv()
    D, Nn = krylov_polys(Minv, K, R)
    RK = R.transpose()*K; RKR = (RK*R)[0, 0]
    Nc = [RKR*D[k] - (sum((RK[0, i]*Nn[i][k] for i in range(N)), arb(0)) if k < N else 0) for k in range(N+1)]
    Ja = arb(fq(J))
    return K, M, R, Minv, D, Nn, freqs(D), freqs(Nc, 1), freqs([a+b for a, b in zip(Nc+[arb(0)], [arb(0)]+[Ja*x for x in D])], 1)

def trim(c):
    c = list(c)
    while c[-1].contains(0): c.pop()
    return c

def payload_case(name, l, m, EI, r, mp, Ip, e):
    n = len(l); N, L, Rx, Kx, Mx = system(l, m, EI, r, mp, Ip, e)
    J = float("%.6g" % (10**random.uniform(-1, 0.5)*sum((m[i]+(mp if i == n-1 else 0))*float(arb(L[i]).mid())**2 for i in range(n))))
    K, M, R, Minv, D, Nn, w, wp, wc = modal(Kx, Mx, Rx, J)
    o = dict(name=name, n=n, hub_radius_m=r, lengths_m=l, masses_kg=m, ei_n_m2=EI, payload_mass_kg=mp, payload_inertia_kg_m2=Ip,
             payload_offset_m=e, rotor_inertia_kg_m2=J, dof=N)
    o["natural_frequencies_rad_s"] = [fl(x) for x in w]; o["pinned_frequencies_rad_s"] = [fl(x) for x in wp]; o["coupled_frequencies_rad_s"] = [fl(x) for x in wc]
    assert len(w) == N and len(wp) == N-1 and len(wc) == N
    o["zeros_z"] = {str(i+1): [flc(x) for x in sortz(roots_of(trim(Nn[i])))] for i in range(n)}
    om = omegas(w[0].mid(), w[-1].mid(), [float(x.mid()) for x in w]); o["omega_rad_s"] = om
    o["response"] = []; o["ct"] = []; o["tip_slope_response"] = []
    RK = R.transpose()*K
    for x in om:
        wq = arb(fq(x)); q = dyn_response(M, K, R, None, wq)
        ct = sum((RK[0, i]*(R[i, 0]-q[i]) for i in range(N)), acb(0))
        ct2 = sum((R[i, 0]*M[i, j]*q[j] for i in range(N) for j in range(N)), acb(0))*(-wq*wq); assert ct.overlaps(ct2)
        o["response"].append([flc(q[i]/arb(L[i])) for i in range(n)]); o["ct"].append(flc(ct))
        if N > n: o["tip_slope_response"].append(flc(q[n]))
    if N == n: del o["tip_slope_response"]
    return o

def lu(lo, dec): return float("%.6g" % (lo*10**(random.random()*dec)))

def main():
    ctx.prec = 1500
    cases = []
    pat = ["mie", "me", "mi", "m", "i", "mie"]
    for k in range(22):
        n = 1+k % 4; pt = pat[(k//2) % 6] if k < 20 else "mie"
        l = [lu(0.1, 1) for _ in range(n)]; m = [lu(0.1, 1) for _ in range(n)]; EI = [lu(0.5, 1) for _ in range(n)]
        r = lu(0.02, 1) if k % 3 == 1 else 0.0
        mp = lu(0.2, 1) if "m" in pt else 0.0; e = lu(0.03, 1) if "e" in pt else 0.0
        Ip = lu(0.003, 1.5) if "i" in pt else 0.0
        cases.append(payload_case("p_%02d_%s" % (k, pt), l, m, EI, r, mp, Ip, e))
    json.dump(dict(about="PART 2, see make_payload.py; SI", cases=cases), open("payload.json", "w"), separators=(",", ":"))
    for o in cases:
        print(o["name"], o["n"], {i: [z for z in v] if any(q[1] for q in v) else "real %s" % ["%+d" % (1 if q[0] > 0 else -1) for q in v] for i, v in o["zeros_z"].items()})
    # ---- PART 4
    out = []
    for k in range(6):
        n = 2+k % 2; kind = "proportional" if k < 3 else "modal"
        l = [lu(0.1, 1) for _ in range(n)]; m = [lu(0.1, 1) for _ in range(n)]; EI = [lu(0.5, 1) for _ in range(n)]
        r = lu(0.02, 1) if k in (1, 4) else 0.0
        N, L, Rx, Kx, Mx = system(l, m, EI, r, 0.0, 0.0, 0.0)
        K, M, R, Minv, D, Nn, w, wp, wc = modal(Kx, Mx, Rx, 1.0)
        w1 = float(w[0].mid()); wn = float(w[-1].mid())
        o = dict(name="%s_%d" % (kind, k), kind=kind, n=n, hub_radius_m=r, lengths_m=l, masses_kg=m, ei_n_m2=EI)
        if kind == "proportional":
            al = float("%.4g" % (0.05*w1)) if k != 1 else 0.0; be = float("%.4g" % (0.1/wn)) if k != 2 else 0.0
            if k == 0: be = float("%.4g" % (1.5/wn))
            o["alpha_1_per_s"] = al; o["beta_s"] = be
            ala, bea = arb(fq(al)), arb(fq(be)); C = M*ala + K*bea
        else:
            zt = [[0.01, 0.02, 0.03], [0.05, 0.3, 0.7], [0.02, 0.0, 0.1]][k-3][:n]; o["zeta"] = zt
        o["natural_frequencies_rad_s"] = [fl(x) for x in w]
        za = []
        for i, x in enumerate(w):
            za.append(ala/(2*x)+bea*x/2 if kind == "proportional" else arb(fq(zt[i])))
        ps = []
        for x, z in zip(w, za):
            d = z*z-1; assert not d.contains(0)
            rt = acb(d).sqrt(); ps += [x*(-z+rt), x*(-z-rt)]
        o["zeta_effective"] = [fl(x) if not x.is_zero() else 0.0 for x in za]
        o["damped_poles_s"] = [flc(x) for x in ps]
        om = omegas(w[0].mid(), w[-1].mid(), [float(x.mid()) for x in w]); o["omega_rad_s"] = om
        o["response"] = []; o["ct"] = []
        if kind == "modal":     # M-orthonormal modes: null vectors of K - w^2 M (M diagonal)
            Phi = []
            for x in w:
                A = K - M*(x*x)   # phi_n = 1, solve the first n-1 rows
                v = arb_mat([[A[i, j] for j in range(n-1)] for i in range(n-1)]).solve(arb_mat([[-A[i, n-1]] for i in range(n-1)]))
                v = [v[i, 0] for i in range(n-1)] + [arb(1)]
                nr = sum((M[i, i]*v[i]**2 for i in range(n)), arb(0)).sqrt(); Phi.append([q/nr for q in v])
            for a in range(n):
                for b in range(n):
                    assert sum((M[i, i]*Phi[a][i]*Phi[b][i] for i in range(n)), arb(0)).overlaps(arb(1 if a == b else 0))
        for x in om:
            wq = arb(fq(x)); s = acb(0, wq)
            if kind == "proportional":
                Z = acb_mat([[K[i, j]*(1+s*bea) + M[i, j]*(s*s+ala*s) for j in range(n)] for i in range(n)])
                KR = K*R
                q = Z.solve(acb_mat([[KR[i, 0]*(1+s*bea)] for i in range(n)])); q = [q[i, 0] for i in range(n)]
                RK = R.transpose()*K
                ct = sum((RK[0, i]*(R[i, 0]-q[i]) for i in range(n)), acb(0))*(1+s*bea)
                ct2 = sum((R[i, 0]*M[i, i]*q[i] for i in range(n)), acb(0))*(s*s+ala*s); assert ct.overlaps(ct2)
            else:
                g = [sum((Phi[a][i]*M[i, i]*R[i, 0] for i in range(n)), arb(0)) for a in range(n)]
                eta = [-g[a]*s*s/(s*s+2*za[a]*w[a]*s+w[a]**2) for a in range(n)]
                q = [R[i, 0]+sum((Phi[a][i]*eta[a] for a in range(n)), acb(0)) for i in range(n)]
                ct = sum((R[i, 0]*M[i, i]*q[i] for i in range(n)), acb(0))*s*s
            o["response"].append([flc(q[i]/arb(L[i])) for i in range(n)]); o["ct"].append(flc(ct))
        out.append(o)
    # extra: payload centre INBOARD of the tip (negative offset); interior masses may then have complex zeros
    extra = [payload_case("neg_offset_complex", [0.88107, 1.19321, 0.644361, 0.425884], [0.759137, 0.627, 0.34458, 0.583372], [2.0044, 3.10627, 2.37668, 2.25004],
                          0.0, 1.91565, 0.05, -0.781796),
             payload_case("neg_offset_2", [0.5, 0.7], [0.3, 0.4], [1.0, 2.0], 0.1, 0.8, 0.01, -0.3)]
    for o in extra: print(o["name"], o["zeros_z"])
    json.dump(dict(about="PART 2, see make_payload.py; SI", cases=cases, negative_offset_cases=extra), open("payload.json", "w"), separators=(",", ":"))
    json.dump(dict(about="PART 4, see make_payload.py; SI", cases=out), open("damping.json", "w"), separators=(",", ":"))
main()
