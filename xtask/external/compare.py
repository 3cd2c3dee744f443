import arm, with_scipy, with_mujoco, time, numpy as np, sys
es = arm.load(sys.argv[1])
for e in es:
    h0 = arm.harmonics(e, e.current)
    n=e.masses+1
    order=[0,*range(2,2+e.masses),1,*range(2+e.masses,2+2*e.masses)]
    mine=e.states[:, order]
    print(e.name, 'max angle', abs(mine[:,0]).max(), 'sat', (abs(e.current)>=e.limit_a).mean(), 'h', [abs(x) for x in h0], 'lissom', e.lissom_s)
    def show(name, f):
        t=time.perf_counter(); c,s=f(); t=time.perf_counter()-t
        h=arm.harmonics(e,c)
        print(f"  {name}: {t:.3f} s; angles {abs(s-mine)[:,:n].max():.2e} current {abs(c-e.current).max():.1e}", 'harm', [f'{abs(a-b)/abs(b):.2e}' for a,b in zip(h,h0)], flush=True)
    for dt in (1e-3, 1e-4):
        for integ in ('Euler','implicitfast','RK4'):
            show(f'mujoco {integ} {dt}', lambda: with_mujoco.run(e, dt, integ))
    if len(sys.argv)>2: show('scipy', lambda: with_scipy.run(e))
