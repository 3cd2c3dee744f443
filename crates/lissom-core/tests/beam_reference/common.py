"""Shared helpers for make_*.py : exact inputs, direct solution of (2)-(5), root finding, conversion."""
from flint import *
import json, math, random

def fq(x):
    a, b = float(x).as_integer_ratio()
    return fmpq(a, b)

def direct_system(l, EI):
    """Equations (2)-(5) (EI per span) in the 4n unknowns u_{i,j}; rhs columns y(L_1)..y(L_n), T_n.
    Rows ordered along the beam so the matrix is banded. l, EI are fmpq."""
    n = len(l); one = fmpq(1); rows = []; rhs = []
    rows.append({0: one}); rhs.append({})                     # (3)
    rows.append({1: one}); rhs.append({})
    for i in range(n):
        a = 4*i; L = l[i]
        rows.append({a: one, a+1: L, a+2: L*L, a+3: L*L*L}); rhs.append({i: one})          # (5)
        if i < n-1:
            b = a+4
            rows.append({a: one, a+1: L, a+2: L*L, a+3: L*L*L, b: -one}); rhs.append({})   # (2)
            rows.append({a+1: one, a+2: 2*L, a+3: 3*L*L, b+1: -one}); rhs.append({})
            rows.append({a+2: EI[i], a+3: 3*EI[i]*L, b+2: -EI[i+1]}); rhs.append({})
        else:
            rows.append({a+2: 2*EI[i], a+3: 6*EI[i]*L}); rhs.append({n: one})              # (4)
    return rows, rhs

def solve_direct(l, EI, exact):
    """returns X[4n][n+1] (fmpq or arb)"""
    n = len(l); rows, rhs = direct_system(l, EI); N = 4*n
    if exact:
        A = fmpq_mat([[r.get(j, fmpq(0)) for j in range(N)] for r in rows])
        B = fmpq_mat([[r.get(j, fmpq(0)) for j in range(n+1)] for r in rhs])
        return A.solve(B).tolist()
    rows = [{k: arb(v) for k, v in r.items()} for r in rows]
    rhs = [{k: arb(v) for k, v in r.items()} for r in rhs]
    # banded Gaussian elimination with partial pivoting, balls carry the error
    for c in range(N):
        cand = [i for i in range(c, min(N, c+10)) if c in rows[i] and not rows[i][c].contains(0)]
        p = max(cand, key=lambda i: abs(rows[i][c]).mid())
        rows[c], rows[p] = rows[p], rows[c]; rhs[c], rhs[p] = rhs[p], rhs[c]
        piv = rows[c][c]
        for i in range(c+1, min(N, c+10)):
            if c in rows[i]:
                f = rows[i].pop(c)/piv
                for k, v in rows[c].items():
                    if k != c: rows[i][k] = rows[i].get(k, arb(0)) - f*v
                for k, v in rhs[c].items():
                    rhs[i][k] = rhs[i].get(k, arb(0)) - f*v
    X = [None]*N
    for c in range(N-1, -1, -1):
        v = [rhs[c].get(k, arb(0)) for k in range(n+1)]
        for k, a in rows[c].items():
            if k != c:
                xk = X[k]; v = [p-a*q for p, q in zip(v, xk)]
        piv = rows[c][c]
        X[c] = [p/piv for p in v]
    return X

def fl(x):
    """nearest double of an arb / fmpq (checks accuracy of the ball)"""
    if isinstance(x, fmpq): x = arb(x)
    if not isinstance(x, arb): return float(x)
    if x.contains(0):
        if x.is_zero() or abs(x).upper() < arb(2)**-1000: return 0.0
        raise ValueError("ball contains zero %s" % x)
    if x.rel_accuracy_bits() < 80: raise ValueError("inaccurate %s" % x)
    return float(x.mid())
def flc(z): 
    z = acb(z); return [fl0(z.real, abs(z)), fl0(z.imag, abs(z))]
def fl0(x, scale):
    """component of a complex number: zero if indistinguishable from 0 at 1e-60 of the modulus"""
    if x.contains(0):
        if x.is_zero() or abs(x).upper() < scale.lower()*arb(10)**-60: return 0.0
        raise ValueError("component contains zero %s" % x)
    return fl(x)

class NeedPrec(Exception): pass

def poly_roots(c, drop=0):
    """all roots of the polynomial with arb coefficients c (ascending), after dropping the `drop` lowest
    (exactly zero, ball contains zero) coefficients; certified isolated; scaled."""
    for k in range(drop):
        assert c[k].contains(0), c[k]
    c = list(c[drop:])
    while len(c) > 1 and c[-1].contains(0):
        if c[-1].is_exact(): c.pop()
        else: raise NeedPrec("leading coefficient %s" % c[-1])
    n = len(c)-1
    if n == 0: return []
    if c[0].contains(0): raise NeedPrec("constant coefficient %s" % c[0])
    if n == 1: return [acb(-c[0]/c[1])]
    # scale by power of two near |c0/cn|^(1/n)
    e = (abs(c[0]/c[n]).log()/arb(2).log()/n).mid()
    e = int(round(float(e)))
    s = arb(2)**e
    cs = [c[k]*s**k for k in range(n+1)]
    try:
        rt = acb_poly(cs).roots()
    except ValueError as ex:
        raise NeedPrec(str(ex))
    return [r*s for r in rt]

def refine(c, roots, bits=250, drop=0):
    """Newton refinement of isolated roots; returns balls with a-posteriori radius n|p/p'|; certifies
    that the refined balls are pairwise disjoint and (conjugate symmetric ones) real."""
    c = list(c[drop:])
    while len(c) > 1 and c[-1].contains(0): c.pop()
    n = len(c)-1
    if n <= 1: return roots
    p = acb_poly(c); dp = p.derivative(); out = []
    for r in roots:
        real = r.imag.contains(0)
        x = acb(r.real.mid(), 0 if real else r.imag.mid())
        for it in range(60):
            d = p(x)/dp(x)
            xn = x-d
            xn = acb(xn.real.mid(), 0 if real else xn.imag.mid())
            done = abs(d).upper() < abs(x).lower()*arb(2)**(-bits)
            x = xn
            if done: break
        else: raise NeedPrec("newton")
        rad = (abs(p(x)/dp(x))*n).upper()
        if not rad < abs(x).lower()*arb(2)**(-110): raise NeedPrec("radius")
        out.append(acb(arb(x.real.mid(), rad.mid()*1.01), arb(0) if real else arb(x.imag.mid(), rad.mid()*1.01)))
    # disjointness
    s = sorted(out, key=lambda q: float(abs(q).mid()))
    for i in range(len(s)):
        for j in range(i+1, len(s)):
            if s[i].overlaps(s[j]): raise NeedPrec("roots not separated")
            if float(abs(s[j]).mid()) > 1.0001*float(abs(s[i]).mid()): break
    return out

def roots_of(c, drop=0):
    return refine(c, poly_roots(c, drop), drop=drop)

def freqs(c, drop=0):
    """polynomial in z whose roots are -omega^2: ascending omega"""
    out = []
    for r in roots_of(c, drop):
        assert r.imag.is_zero() and r.real < 0, r
        out.append((-r.real).sqrt())
    return sorted(out, key=lambda a: a.mid())

def sortz(zs): return sorted(zs, key=lambda z: (round(float(abs(z).mid()), 12) if abs(z) < 1e300 else 1e300, float(z.real.mid()), float(z.imag.mid())))

# ---- transfer route (independent of the K matrix): state (w, w', EI w'', EI w''') of the absolute arc position
def transfer_cols(l, EI, g, r, one, zero):
    """columns for base states theta:(r,1,0,0), M0:(0,0,1,0), V0:(0,0,0,1); g[i] = m_i s^2 + c_i s.
    Returns final columns (after the last mass) and w at every mass for the three columns."""
    cols = [[r*one, one, zero, zero], [zero, zero, one, zero], [zero, zero, zero, one]]
    ws = []
    for i in range(len(l)):
        L = l[i]; a = L/EI[i]; b = a*L/2; d = b*L/3; w = []
        for c in cols:
            W, F, M, V = c
            c[0] = W + F*L + M*b + V*d
            c[1] = F + M*a + V*b
            c[2] = M + V*L
            c[3] = V - g[i]*c[0]
            w.append(c[0])
        ws.append(w)
    return cols, ws

def transfer_polys(l, EI, m, r, which):
    """D(z), Ct numerator, {i: numerator of yhat_i/theta_m} as arb coefficient lists (ascending)"""
    n = len(l)
    g = [arb_poly([0, x]) for x in m]
    cols, ws = transfer_cols(l, EI, g, r, arb_poly([1]), arb_poly([]))
    th, M, V = cols
    D = M[2]*V[3]-M[3]*V[2]
    NM = th[3]*V[2]-th[2]*V[3]           # M0 = NM/D
    NV = th[2]*M[3]-th[3]*M[2]           # V0 = NV/D
    def cut(p, deg):
        c = p.coeffs() + [arb(0)]*(deg+1)
        assert all(x.contains(0) for x in c[deg+1:]); return c[:deg+1]
    num = {i: cut(ws[i][0]*D + ws[i][1]*NM + ws[i][2]*NV, n-1) for i in which}
    return cut(D, n), cut(-NM + NV*r, n), num

def transfer_response(l, EI, g, r):
    """all yhat_i/theta_m and Ct/theta_m"""
    cols, ws = transfer_cols(l, EI, g, r, acb(1), acb(0))
    th, M, V = cols
    D = M[2]*V[3]-M[3]*V[2]
    M0 = (th[3]*V[2]-th[2]*V[3])/D
    V0 = (th[2]*M[3]-th[3]*M[2])/D
    return [w[0]+w[1]*M0+w[2]*V0 for w in ws], -M0+V0*r

# ---- matrix route
def krylov_polys(Minv, K, R, C=None):
    """D, numerators N_i (vector), from (zI-A)^-1 b.  Undamped: variable z=s^2.  With C: variable s (state space)."""
    n = K.nrows()
    A = Minv*K*(-1); b = Minv*K*R
    if C is not None:
        B = Minv*C*(-1)
        A = arb_mat([[arb(1) if j == n+i else arb(0) for j in range(2*n)] for i in range(n)] +
                    [[A[i, j] for j in range(n)]+[B[i, j] for j in range(n)] for i in range(n)])
        b = arb_mat([[arb(0)] for _ in range(n)] + [[b[i, 0]] for i in range(n)])
    c = A.charpoly().coeffs(); N = A.nrows()
    v = b; vs = [v]
    for k in range(N-1, 0, -1):
        v = A*v + b*c[k]; vs.append(v)
    vs = vs[::-1]
    chk = A*vs[0] + b*c[0]
    assert all(chk[i, 0].contains(0) for i in range(N))
    return c, [[vs[k][i, 0] for k in range(N)] for i in range(n)]

def dyn_response(M, K, R, C, w):
    """q/theta_m at s=jw by a direct solve"""
    n = K.nrows(); w = arb(w)
    Z = acb_mat([[acb(K[i, j]-w*w*M[i, j], w*C[i, j] if C is not None else 0) for j in range(n)] for i in range(n)])
    rhs = K*R
    q = Z.solve(acb_mat([[acb(rhs[i, 0])] for i in range(n)]))
    return [q[i, 0] for i in range(n)]

def omegas(w1, wtop, nat, count=12):
    """log spaced between 0.1 w1 and 10 wtop, rounded to 6 digits, moved off any pole by > 1e-4 relative"""
    a, b = 0.1*float(w1), 10*float(wtop); out = []
    for k in range(count):
        w = float("%.6g" % (a*(b/a)**(k/(count-1))))
        while any(abs(w-float(x)) < 3e-4*w for x in nat): w = float("%.6g" % (w*1.0007))
        out.append(w)
    return out
