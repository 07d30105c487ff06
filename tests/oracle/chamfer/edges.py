#!/usr/bin/python3
# Independent solution of the chamfer, by mpmath and general root finding: general oblique circle/rounded hole, cylinder or plane body. Section & swept centre with mpmath.
from mpmath import *
mp.dps=30   # run: python3 edges.py (needs python3-mpmath); edges.json is its output
class Edge:
    def __init__(s,R1=None,R2=5,a=0,b=0,f=0,beta=0,m=1,side=1,plane=None):
        s.R1,s.R2,s.a,s.b,s.f,s.beta,s.m,s.side,s.plane=R1,mpf(R2),mpf(a),mpf(b),mpf(f),radians(mpf(beta)),m,side,plane
        # hole frame: A1 direction = (0, cos b, sin b); point (-f,0,0)
        s.A1=matrix([0,cos(s.beta),sin(s.beta)]); s.O=matrix([-s.f,0,0])
    def F(s,p):
        if s.plane is not None: # normal n, offset
            n,c=s.plane; return sum(n[i]*p[i] for i in range(3))-c
        d=p-s.O; al=sum(d[i]*s.A1[i] for i in range(3)); r=d-al*s.A1
        return sqrt(sum(r[i]**2 for i in range(3)))-s.R1
    def n1(s,p):
        if s.plane is not None: return matrix(s.plane[0])
        d=p-s.O; al=sum(d[i]*s.A1[i] for i in range(3)); r=d-al*s.A1
        return r/norm(r)
    def prof(s,u): # arc-length u in mm, start phi=0 (x+), ccw ; a half across(x), b half along(y)
        a,b,R=s.a,s.b,s.R2
        segs=[('l',b,(a+R,0),(0,1)),('c',R*pi/2,(a,b),0),('l',2*a,(a,b+R),(-1,0)),('c',R*pi/2,(-a,b),pi/2),('l',2*b,(-a-R,b),(0,-1)),
              ('c',R*pi/2,(-a,-b),pi),('l',2*a,(-a,-b-R),(1,0)),('c',R*pi/2,(a,-b),3*pi/2),('l',b,(a+R,-b),(0,1))]
        L=sum(x[1] for x in segs); u=u-floor(u/L)*L
        for k,l,p,q in segs:
            if u<=l:
                if k=='l': return mpf(p[0])+q[0]*u, mpf(p[1])+q[1]*u, q[1],-q[0]
                t=q+u/R; return p[0]+R*cos(t),p[1]+R*sin(t),cos(t),sin(t)
            u-=l
        raise Exception
    def perim(s): return 2*pi*s.R2+4*s.a+4*s.b
    def s(self,p):
        qx=abs(p[0])-self.a; qy=abs(p[1])-self.b
        return sqrt(max(qx,0)**2+max(qy,0)**2)+min(max(qx,qy),0)-self.R2
    def P(s,u):
        x,y,nx,ny=s.prof(u)
        if s.plane is not None:
            n,c=s.plane; z=(c-n[0]*x-n[1]*y)/n[2]
        else:
            # |d x A1|^2=R1^2 ; d=(x+f,y,z): perpendicular comps: x+f, and -y sin + z cos
            w=s.side*sqrt(s.R1**2-(x+s.f)**2); z=(w+y*sin(s.beta))/cos(s.beta)
        return matrix([x,y,z]),matrix([nx,ny,0])
def dot(a,b): return sum(a[i]*b[i] for i in range(3))
def cross(a,b): return matrix([a[1]*b[2]-a[2]*b[1],a[2]*b[0]-a[0]*b[2],a[0]*b[1]-a[1]*b[0]])
def section(E,u,W,D,delta=None):
    P,n2=E.P(u); n1=E.n1(P); e1=n2; v=E.m*n1; e2=v-dot(v,e1)*e1; e2=e2/norm(e2)
    th=acos(-dot(v,e1)); d=pi/2-th/2 if delta is None else delta
    dv=sin(d)*e1-cos(d)*e2
    def eq(S,T):
        G2=P+S*e1+T*e2; G1=G2+W*dv
        return [E.s(G2),E.F(G1)]
    T0=W*cos(d)*mpf('0.9')
    x=findroot(eq,(mpf(0),T0),tol=1e-24)
    G2=P+x[0]*e1+x[1]*e2; G1=G2+W*dv
    C=(G1+G2)/2-sqrt(D**2-W**2/4)*(cos(d)*e1+sin(d)*e2)
    return P,G1,G2,C,e1,e2,d
def swept(E,u,W,D,delta=None):
    P,G1,G2,C,e1,e2,d=section(E,u,W,D,delta)
    B=lambda k: (lambda w: section(E,w,W,D,delta if delta is None else delta)[k])
    h=mpf('1e-9')
    def eq(Sc,Tc,a,b):
        X=P+Sc*e1+Tc*e2
        r=[]
        for k,sh in ((1,a),(2,b)):
            Bk=section(E,u+sh,W,D,delta)[k]; Bp=section(E,u+sh+h,W,D,delta)[k]; Bm=section(E,u+sh-h,W,D,delta)[k]
            dB=(Bp-Bm)/(2*h); v=X-Bk
            r+= [norm(v)-D, dot(v,dB)]
        return r
    q=C-P
    x=findroot(eq,(dot(q,e1),dot(q,e2),mpf(0),mpf(0)),tol=1e-20,maxsteps=60)
    return P+x[0]*e1+x[1]*e2, x

# Writes edges.json: random edges of every profile and body with the centres of both methods, in the hole frame.
if __name__ == '__main__':
    import json, random
    rnd = random.Random(20260711)
    out = []
    kinds = ['circle', 'elongated', 'rounded_rectangle']
    while len(out) < 24:
        k = kinds[len(out) % 3]
        outer = len(out) % 2
        plane = outer and len(out) % 4 == 1
        side = 1 if plane or len(out) % 8 < 4 else -1
        beta = 0 if len(out) % 5 == 0 else rnd.choice([-1, 1]) * rnd.uniform(1, 60)
        R1 = rnd.uniform(8, 40)
        half = R1 * rnd.uniform(0.15, 0.6)
        a = half * rnd.uniform(0.1, 0.6) if k == 'rounded_rectangle' else 0
        R2 = half - a
        b = 0 if k == 'circle' else rnd.uniform(0.5, 6)
        f = rnd.choice([-1, 1]) * rnd.uniform(0, 0.9) * (R1 - half)
        W, D = rnd.uniform(0.1, 0.5), rnd.uniform(0.25, 0.6) * R2
        if D < 0.8 * W: continue
        delta = None if len(out) % 3 else rnd.uniform(30, 60)
        v = lambda x: round(x, 6)
        R1, R2, a, b, f, W, D, beta = map(v, (R1, R2, a, b, f, W, D, beta))
        if delta is not None: delta = v(delta)
        bt = radians(mpf(beta))
        E = Edge(R1=mpf(R1), R2=R2, a=a, b=b, f=f, beta=beta, m=-1 if outer else 1, side=side,
                 plane=((mpf(0), -sin(bt), cos(bt)), mpf(R1)) if plane else None)
        points = []
        try:
            for i in range(4):
                u = mpf(v(rnd.random()))
                d = None if delta is None else radians(mpf(delta))
                uu = u * E.perim()
                P, G1, G2, C, e1, e2, dd = section(E, uu, mpf(W), mpf(D), d)
                S, x = swept(E, uu, mpf(W), mpf(D), d)
                if E.m * E.F(G2) < 0 or E.s(G1) < 0: raise ValueError('leaves its surfaces')
                for k in range(12):
                    q = section(E, (u + mpf(2 * k - 11) / 100) * E.perim(), mpf(W), mpf(D), d)
                    if min(norm(S - q[1]), norm(S - q[2])) < D - mpf('1e-9'): raise ValueError('the ball does not fit')
                n = lambda p: [nstr(c, 17) for c in p]
                points.append({'u': float(u), 'P': n(P), 'G1': n(G1), 'G2': n(G2), 'section': n(C), 'swept': n(S)})
        except (ValueError, ZeroDivisionError) as e:
            continue
        out.append({'name': f"{len(out):02d}_{k}_{'face' if plane else 'outer' if outer else 'inner'}", 'body': 'plane' if plane else 'cylinder', 'm': -1 if outer else 1,
                    'side': 'entry' if side > 0 else 'exit', 'R1': R1, 'R2': R2, 'straight_along': 2 * b, 'straight_across': 2 * a, 'f': f,
                    'penetration_angle': beta, 'W': W, 'D': D, 'delta': delta, 'points': points})
    json.dump(out, open('edges.json', 'w'), indent=1)
