%
(program 9101)
(Ridgeline chamfer: tube-40 H1 [inner, entry])
(width 0.5 mm, tolerance 0.002 mm, tool 12 d6 lollipop)
(tool axis 0.707107 0 0.707107)
(coordinates of the work frame:)
(set the rotary axes to the tool axis before this program)
G17 G21 G40 G49 G61 G80 G90 G91.1 G94 G97
G54
T12 M6
S8000 M3
G43 H12
G0 X0 Y0
Z60
Z30
G1 Z17.6502 F1000
G3 X2.7896 Y0 I1.3948 J0 F150
G1 X0 Y3.0628 Z18.0628 F300
G3 X-3.0628 Y0 Z17.6502 I0 J-3.0628
G3 X0 Y-3.0628 Z18.0628 I3.0628 J0 F292.6
G1 X2.7896 Y0 Z17.6502 F300
X0 F600
G0 Z60
M5
M2
%
