# N fines of d in a cube gas, optionally one giant
import sys,random
n=int(sys.argv[1]); d=float(sys.argv[2]); L=float(sys.argv[3]); giant=float(sys.argv[4]); out=sys.argv[5]
m=round(n**(1/3)); random.seed(1)
rows=[]
c=L/2
for i in range(m):
  for j in range(m):
    for k in range(m):
      p=[(q+0.5)*L/m+(random.random()-.5)*0.2*L/m for q in (i,j,k)]
      if giant and sum((a-c)**2 for a in p)**.5<giant/2+d: continue
      rows.append(p+[d])
if giant: rows.append([c,c,c,giant])
open(out,'w').write('x,y,z,diameter\n'+''.join(','.join('%.9g'%v for v in r)+'\n' for r in rows))
print(len(rows))
