#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/simple_wave.hpp"

namespace tushar::reference {

namespace {

struct WaveSection : GasTags {
  input::Expression velocity{0.0};
  double density = 1, soundSpeed = 1;
  double lower = 0, upper = 1;
};
const input::Schema<WaveSection>& waveSchema() {
  static const input::Schema<WaveSection> schema =
      gasSchema<WaveSection>("simpleWave", "Errors relative to a simple wave that moves towards +x into gas at rest.")
          .required("velocity", &WaveSection::velocity, "m/s", "velocity at t = 0, a formula in x")
          .ours()
          .value("density", &WaveSection::density, 1, "kg/m^3", "density at rest", input::positive())
          .ours()
          .value("sound_speed", &WaveSection::soundSpeed, 1, "m/s", "speed of sound at rest", input::positive())
          .ours()
          .value("lower", &WaveSection::lower, 0, "m", "position at which the profile begins")
          .ours()
          .value("upper", &WaveSection::upper, 1, "m", "position at which the profile ends")
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind simpleWaveKind() {
  return gasModule("simpleWave", "errors relative to a simple wave that moves towards +x", waveSchema,
                   [](const WaveSection& read, const grid::Level& level) {
                     if (axesOf(level)[0] == 0)
                       throw std::invalid_argument("the wave moves along x, but this grid does not use x");
                     SimpleWaveProblem problem;
                     problem.velocity = [velocity = read.velocity](double x) { return velocity(Vec3(x, 0, 0)); };
                     problem.density = read.density;
                     problem.soundSpeed = read.soundSpeed;
                     problem.gamma = read.gamma;
                     problem.lower = read.lower;
                     problem.upper = read.upper;
                     return std::make_shared<SimpleWave>(problem);
                   });
}

}  // namespace tushar::reference
