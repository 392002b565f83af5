#include "components/mpm/gas/conserving/update_particles.hpp"

namespace tushar::mpm::gas::conserving {

template void updateParticles<1, Apic>(const Patch&, const Gas&, const ParticleUpdate<1>&, double, Minimum&);
template void updateParticles<1, AffineFlip>(const Patch&, const Gas&, const ParticleUpdate<1>&, double, Minimum&);
template void updateParticles<2, Apic>(const Patch&, const Gas&, const ParticleUpdate<2>&, double, Minimum&);
template void updateParticles<2, AffineFlip>(const Patch&, const Gas&, const ParticleUpdate<2>&, double, Minimum&);
template void updateParticles<3, Apic>(const Patch&, const Gas&, const ParticleUpdate<3>&, double, Minimum&);
template void updateParticles<3, AffineFlip>(const Patch&, const Gas&, const ParticleUpdate<3>&, double, Minimum&);

}  // namespace tushar::mpm::gas::conserving
