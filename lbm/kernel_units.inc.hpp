// What the kernel units of one instruction set offer; included once in the namespace of each (kernel.cpp).

Kernel<float> kernel_float(Law law, bool rescale);
Kernel<double> kernel_double(Law law, bool rescale);
WallKernel<float> walls_float();
WallKernel<double> walls_double();
FluxKernel<float> fluxes_float();
FluxKernel<double> fluxes_double();
VelocityKernel<float> velocities_float();
VelocityKernel<double> velocities_double();
GradientKernel gradients();
