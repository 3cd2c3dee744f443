#!/usr/bin/env python3
"""PART 3 -> distributed.json : Euler-Bernoulli beams, piecewise constant EI, mu; point masses at piece ends; hub radius; payload.

State (w, w', M=EI w'', V=EI w''') of the absolute arc position w; 4x4 transfer with Krylov functions (ball arithmetic, flint arb).
Hub: w(r)=r th_m, w'(r)=th_m.  Point mass: V+ = V - m z w (z=s^2).  Tip: V = m_p z (w + e w'), M = -I_p z w' - m_p e z (w+e w').
C_t = -M(r) + r V(r).  D = det of the two base columns (M0,V0) in the tip residuals; tip numerator, Ct numerator by Cramer.
Roots: D, C_t numerator, J z D + C_t numerator and the tip numerator are entire functions of z; their Taylor
polynomials (exact arithmetic in balls, T terms) are factored completely (all roots, complex ones included); every kept root is
verified on the closed-form transcendental function (sign change at 1 +- 1e-28, or complex Newton step < 1e-28) and the
number of roots is verified by the argument principle on a circle and (frequencies) by a fine Hermite FE model in floats.
"""
from common import *
import numpy as np, scipy.linalg as sl, sys, time
random.seed(31337)
fact = [1]
for _k in range(1, 900): fact.append(fact[-1]*_k)

class Beam:
    def __init__(s, l, EI, mu, pm, r, mp, Ip, e):
        s.raw = (l, EI, mu, pm, r, mp, Ip, e)
        f = lambda v: [fq(x) for x in v]
        s.l, s.EI, s.mu, s.pm = f(l), f(EI), f(mu), f(pm); s.r, s.mp, s.Ip, s.e = fq(r), fq(mp), fq(Ip), fq(e)
        s.L = []; x = s.r
        for a in s.l: x = x+a; s.L.append(x)
    def cols(s, kry, z, one, zero):
        cols = [[one*arb(s.r), one, zero, zero], [zero, zero, one, zero], [zero, zero, zero, one]]; ws = []
        for i in range(len(s.l)):
            E = arb(s.EI[i]); c0, c1, c2, c3, k = kry(i); w = []
            for c in cols:
                W, F, M, V = c; m = M*(1/E); v = V*(1/E)
                kW = k*W; kF = k*F
                c[0] = W*c0+F*c1+m*c2+v*c3
                c[1] = kW*c3+F*c0+m*c1+v*c2
                c[2] = (kW*c2+kF*c3+m*c0+v*c1)*E
                c[3] = (kW*c1+kF*c2+k*(m*c3)+v*c0)*E
                c[3] = c[3]-z*c[0]*arb(s.pm[i])
                w.append(c[0])
            ws.append(w)
        R = []
        for c in cols:
            q = z*(c[0]+c[1]*arb(s.e))*arb(s.mp)
            R.append((c[3]-q, c[2]+z*c[1]*arb(s.Ip)+q*arb(s.e)))
        return ws, R
    @staticmethod
    def dets(ws, R, r):
        th, M, V = R
        d = lambda a, b: a[0]*b[1]-a[1]*b[0]
        D = d(M, V); NM = d(V, th); NV = d(th, M)      # M0 = NM/D, V0 = NV/D
        return D, NV*arb(r)-NM, [w[0]*D+w[1]*NM+w[2]*NV for w in ws]
    def at(s, z):
        z = acb(z)
        def kry(i):
            k = -z*arb(s.mu[i])/arb(s.EI[i]); lam = k.sqrt().sqrt(); x = lam*arb(s.l[i])
            ch, sh = x.cosh(), x.sinh(); c, sn = x.cos(), x.sin()
            return (ch+c)/2, (sh+sn)/(2*lam), (ch-c)/(2*lam**2), (sh-sn)/(2*lam**3), k
        ws, R = s.cols(kry, z, acb(1), acb(0)); return s.dets(ws, R, s.r)
    def taylor(s, T):
        ctx.cap = T
        z = arb_series([0, 1])
        def kry(i):
            a = -arb(s.mu[i])/arb(s.EI[i]); l = arb(s.l[i]); out = []
            for j in range(4): out.append(arb_series([a**k*l**(4*k+j)/fact[4*k+j] for k in range(T)]))
            return out+[z*a]
        ws, R = s.cols(kry, z, arb_series([1]), arb_series([])); D, C, N = s.dets(ws, R, s.r)
        g = lambda p: (p.coeffs()+[arb(0)]*T)[:T]
        return g(D), g(C), [g(n) for n in N]

def fsel(B, kind, J=None):
    def f(z):
        D, C, N = B.at(z)
        if kind == "D": return D
        if kind == "C": return C/z
        if kind == "J": return C/z+arb(fq(J))*D
        return N[-1]
    return f

def argcount(f, rad):
    """number of zeros in |z|<rad of a real entire f"""
    rad = arb(rad).mid(); tot = 0.0
    def val(t):
        v = f(acb(rad*arb(t).cos().mid(), rad*arb(t).sin().mid())); return v
    def go(t0, v0, t1, v1, depth):
        q = v1/v0; a = float(q.arg().mid())
        if abs(a) > 0.4 and depth < 30:
            tm = (t0+t1)/2; vm = val(tm); return go(t0, v0, tm, vm, depth+1)+go(tm, vm, t1, v1, depth+1)
        return a
    N = 64; v = val(0.0)
    vpi = f(acb(-rad))
    for k in range(N):
        t1 = math.pi*(k+1)/N; v1 = vpi if k == N-1 else val(t1)
        tot += go(math.pi*k/N, v, t1, v1, 0); v = v1
    n = tot/math.pi; assert abs(n-round(n)) < 1e-6, n
    return int(round(n))

def verify(f, z):
    eps = arb(10)**-28
    if z.imag.is_zero():
        x = z.real.mid(); a, b = f(acb(x*(1-eps))).real, f(acb(x*(1+eps))).real
        assert a*b < 0, ("no sign change", z)
    else:
        x = acb(z.real.mid(), z.imag.mid()); h = x*eps; a = f(x); d = (f(x+h)-f(x-h))/(2*h)
        assert abs(a/d) < abs(x)*eps, ("complex root", z)

def all_roots(c, f, count=None, radius=None, drop=0, pos=None):
    """roots of smallest modulus: `count` of them, or all below radius, or until `pos` positive reals; verified"""
    rt = sorted(poly_roots(c, drop), key=lambda q: float(abs(q).mid()))
    if radius is not None: keep = [q for q in rt if abs(q).mid() < radius*2.0]
    elif pos is not None:
        keep = []; k = 0
        for q in rt:
            keep.append(q); k += (q.imag.contains(0) and q.real > 0)
            if k == pos+1: break
    else: keep = rt[:count+2]
    keep = refine(c, keep, drop=drop)
    keep = sorted(keep, key=lambda q: float(abs(q).mid()))
    if radius is not None:
        keep = [q for q in keep if abs(q) < radius]; R = radius
    else:
        # cut between two distinct moduli
        if pos is not None:
            n = len(keep)-1
        else: n = count
        a, b = abs(keep[n-1]).mid(), abs(keep[n]).mid(); assert b > a*1.0000001, "equal moduli"
        R = (a*b).sqrt(); keep = keep[:n]
    n = argcount(f, R)
    assert n == len(keep), ("count", n, len(keep))
    for q in keep: verify(f, q)
    return sortz(keep)

def fe(B, J, per=40):
    """float Hermite FE: clamped, pinned, coupled frequencies"""
    l, EI, mu, pm, r, mp, Ip, e = B.raw; ne = per*len(l); nd = 2*(ne+1); K = np.zeros((nd, nd)); M = np.zeros((nd, nd)); x = r; xs = [r]
    for p in range(len(l)):
        h = l[p]/per
        k = EI[p]/h**3*np.array([[12, 6*h, -12, 6*h], [6*h, 4*h*h, -6*h, 2*h*h], [-12, -6*h, 12, -6*h], [6*h, 2*h*h, -6*h, 4*h*h]])
        m = mu[p]*h/420*np.array([[156, 22*h, 54, -13*h], [22*h, 4*h*h, 13*h, -3*h*h], [54, 13*h, 156, -22*h], [-13*h, -3*h*h, -22*h, 4*h*h]])
        for q in range(per):
            a = 2*(p*per+q); K[a:a+4, a:a+4] += k; M[a:a+4, a:a+4] += m; x += h; xs.append(x)
        M[2*(p+1)*per, 2*(p+1)*per] += pm[p]
    a = nd-2; M[a, a] += mp; M[a, a+1] += mp*e; M[a+1, a] += mp*e; M[a+1, a+1] += mp*e*e+Ip
    wc = np.sqrt(np.abs(sl.eigh(K[2:, 2:], M[2:, 2:], eigvals_only=True)))
    # motor free: base slope dof = theta, base displacement = r theta
    Tm = np.zeros((nd, nd-1)); Tm[0, 0] = r; Tm[1:, :] = np.eye(nd-1)
    K2 = Tm.T@K@Tm; M2 = Tm.T@M@Tm
    wp = np.sqrt(np.abs(sl.eigh(K2, M2, eigvals_only=True)))[1:]
    M2[0, 0] += J; wj = np.sqrt(np.abs(sl.eigh(K2, M2, eigvals_only=True)))[1:]
    return wc, wp, wj

def case(name, l, EI, mu, pm, r, mp, Ip, e, nf=12, T=110, J=None, npos=6, nom=10, omega=None):
    t0 = time.time(); ctx.prec = 3000
    B = Beam(l, EI, mu, pm, r, mp, Ip, e)
    if J is None:
        Lf = [float(arb(x).mid()) for x in B.L]
        J = float("%.6g" % (10**random.uniform(-1, 0.3)*(sum(mu[i]*l[i]*(Lf[i]-l[i]/2)**2+pm[i]*Lf[i]**2 for i in range(len(l)))+mp*(Lf[-1]+e)**2)))
    D, C, N = B.taylor(T)
    o = dict(name=name, hub_radius_m=r, lengths_m=l, ei_n_m2=EI, mu_kg_per_m=mu, point_masses_kg=pm, payload_mass_kg=mp,
             payload_inertia_kg_m2=Ip, payload_offset_m=e, rotor_inertia_kg_m2=J)
    Ja = arb(fq(J)); CJ = [a+b for a, b in zip(C, [arb(0)]+[Ja*x for x in D])]
    ctx.prec = 3000
    def fr(c, kind, drop):
        ctx.prec = 3000
        z = all_roots(c, fsel(B, kind, J), count=nf, drop=drop)
        assert all(q.imag.is_zero() and q.real < 0 for q in z)
        return [(-q.real).sqrt() for q in z]
    w = fr(D, "D", 0); wp = fr(C, "C", 1); wj = fr(CJ, "J", 1)
    F = fe(B, J, 40 if nf <= 12 else 150); dev = 0
    for a, b in zip((w, wp, wj), F):
        d = max(abs(b[k]/float(a[k].mid())-1) for k in range(nf)); dev = max(dev, d); assert d < 2e-3, d
    o["natural_frequencies_rad_s"] = [fl(x) for x in w]; o["pinned_frequencies_rad_s"] = [fl(x) for x in wp]; o["coupled_frequencies_rad_s"] = [fl(x) for x in wj]
    # tip zeros: all below w6^2 and the first npos positive
    w6 = w[5]
    za = all_roots(N[-1], fsel(B, "N"), radius=(w6*w6).mid())
    zp = all_roots(N[-1], fsel(B, "N"), pos=npos)
    o["tip_zeros_radius_z"] = fl((w6*w6)); o["tip_zeros_z_all_below_radius"] = [flc(z) for z in za]
    o["tip_zeros_z_positive"] = [fl(z.real) for z in zp if z.imag.is_zero() and z.real > 0][:npos]
    o["tip_zeros_z_all_up_to_last_positive"] = [flc(z) for z in zp]
    om = omega or omegas(w[0].mid(), w[min(11, nf-1)].mid()/8, [float(x.mid()) for x in w], nom)
    o["omega_rad_s"] = om; o["response"] = []; o["ct"] = []
    for x in om:
        xa = arb(fq(x)); d, c, n = B.at(-xa*xa)
        o["response"].append([fl((q/d/arb(L)).real) for q, L in zip(n, B.L)]); o["ct"].append(fl((c/d).real))
    print(name, "%.1fs FE dev %.1e" % (time.time()-t0, dev), "zeros<w6^2:", len(za), "neg", sum(z.imag.is_zero() and z.real < 0 for z in za), "complex", sum(not z.imag.is_zero() for z in za),
          "| up to 6th pos:", len(zp), "neg", sum(z.imag.is_zero() and z.real < 0 for z in zp), "complex", sum(not z.imag.is_zero() for z in zp), flush=True)
    return o

def bis(f, a, b):
    a, b = arb(a), arb(b); fa = f(a)
    for _ in range(260):
        m = ((a+b)/2).mid(); fm = f(m)
        if fm*fa > 0: a = m
        else: b = m
    return m

def lu(lo, dec): return float("%.6g" % (lo*10**(random.random()*dec)))

def main():
    cases = []; doc = dict(about="PART 3, see make_distributed.py; SI", cases=cases)
    save = lambda: json.dump(doc, open("distributed.json", "w"), separators=(",", ":"))
    # closed forms
    ctx.prec = 800
    pi = arb.pi()
    lam = [bis(lambda x: x.cos()+1/x.cosh(), pi*k-pi/2-arb("0.35"), pi*k-pi/2+arb("0.35")) for k in range(1, 31)]
    lap = [bis(lambda x: x.sin()-x.tanh()*x.cos(), pi*k+pi/4-arb("0.3"), pi*k+pi/4+arb("0.3")) for k in range(1, 31)]
    zx = [bis(lambda x: x.sin()+x.tanh()*x.cos(), pi*k-pi/4-arb("0.3"), pi*k-pi/4+arb("0.3")) for k in range(1, 16)]
    doc["uniform_closed_form"] = dict(note="EI=mu=l=1: clamped-free 1+cos cosh=0, pinned-free tan=tanh, tip zeros z=4x^4 with tan x=-tanh x",
        clamped_free_lambda=[fl(x) for x in lam], pinned_free_lambda=[fl(x) for x in lap], tip_zero_x=[fl(x) for x in zx], tip_zeros_z=[fl(4*x**4) for x in zx])
    cases.append(case("uniform", [1.0], [1.0], [1.0], [0.0], 0.0, 0.0, 0.0, 0.0, nf=30, T=170, J=0.5, npos=15)); save()
    u = cases[0]
    for a, b in zip(u["natural_frequencies_rad_s"], lam): assert abs(a/float((b*b).mid())-1) < 1e-15
    for a, b in zip(u["pinned_frequencies_rad_s"], lap): assert abs(a/float((b*b).mid())-1) < 1e-15
    for a, b in zip(u["tip_zeros_z_positive"], zx): assert abs(a/float((4*b**4).mid())-1) < 1e-15
    for mp in (0.5, 1.0, 5.0): cases.append(case("uniform_tip_mass_%g" % mp, [1.0], [1.0], [1.0], [0.0], 0.0, mp, 0.0, 0.0))
    cases.append(case("uniform_tip_inertia_0.01", [1.0], [1.0], [1.0], [0.0], 0.0, 0.0, 0.01, 0.0))
    cases.append(case("uniform_tip_inertia_0.5", [1.0], [1.0], [1.0], [0.0], 0.0, 0.0, 0.5, 0.0))
    cases.append(case("uniform_tip_mass_inertia_offset", [1.0], [1.0], [1.0], [0.0], 0.0, 1.0, 0.1, 0.15))
    cases.append(case("uniform_hub", [1.0], [1.0], [1.0], [0.0], 0.2, 0.0, 0.0, 0.0)); save()
    pat = ["", "m", "mi", "mie", "me", "mie", "i", "mie"]
    for k in range(8):
        n = 2+k % 3
        l = [lu(0.1, 1) for _ in range(n)]; EI = [lu(0.5, 1) for _ in range(n)]; mu = [lu(0.1, 1) for _ in range(n)]
        pm = [lu(0.02, 1.3) if random.random() < 0.7 else 0.0 for _ in range(n)]
        r = lu(0.02, 1) if k % 2 else 0.0; pt = pat[k]
        cases.append(case("random_%d_%s" % (k, pt), l, EI, mu, pm, r, lu(0.1, 1) if "m" in pt else 0.0, lu(0.002, 1.5) if "i" in pt else 0.0, lu(0.03, 1) if "e" in pt else 0.0)); save()
if __name__ == "__main__": main()
