# 100,000 places over the inlet tube from x = 0.2 to 5 mm, density over the section as (1 - r/R)^(1/7); no two nearer than 4 um.
import numpy as np
rng=np.random.default_rng(1); R=2.5e-3; n=100000
def draw(m):
    out=np.empty((0,3))
    while len(out)<m:
        y,z=rng.uniform(-R,R,(2,4*m)); r=np.hypot(y,z); ok=(r<R-3e-6)
        ok&=rng.uniform(size=4*m)<np.where(r<R,1-r/R,0)**(1/7)
        out=np.vstack([out,np.c_[rng.uniform(0.2e-3,5e-3,ok.sum()),y[ok],z[ok]]])
    return out[:m]
p=draw(n)
def near(p,d=4e-6):
    key=np.floor(p/d).astype(np.int64); seen={}; bad=set()
    for i,k in enumerate(map(tuple,key)):
        for o in np.ndindex(3,3,3):
            j=seen.get((k[0]+o[0]-1,k[1]+o[1]-1,k[2]+o[2]-1))
            if j is not None and np.linalg.norm(p[i]-p[j])<d: bad.add(i)
        seen[k]=i
    return sorted(bad)
while (b:=near(p)): p[b]=draw(len(b))
np.savetxt('places.csv',p,fmt='%.9g',delimiter=',')
