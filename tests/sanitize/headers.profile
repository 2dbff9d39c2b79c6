# Headers whose lines are not counted.
!src:*/include/eigen3/*
!src:*/include/c[+][+]/*
