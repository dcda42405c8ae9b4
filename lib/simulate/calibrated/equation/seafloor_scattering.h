#pragma once

#include <complex>

#include "input/scene/scene.h"

namespace sonarsim {

/// A sea bed, for the high-frequency model of the Applied Physics Laboratory, University of
/// Washington: APL-UW TR 9407, "High-Frequency Ocean Environmental Acoustic Models Handbook", 1994,
/// section IV; P. D. Mourad and D. R. Jackson, "High frequency sonar equation models for bottom
/// backscatter and forward loss", Proc. OCEANS '89, 1168. It holds from 10 to 100 kHz. Above that
/// it is an extrapolation (docs/calibrated.md).
struct SeaBed {
    double density_ratio = 0.0;  ///< to that of the water
    double speed_ratio = 0.0;    ///< speed of sound to that of the water
    double loss = 0.0;           ///< ratio of imaginary to real part of the wave number
    /// The roughness spectrum is W(K) = strength K^-exponent, K in rad/m, W in m^4.
    double spectral_strength = 0.0;
    double spectral_exponent = 0.0;
    double volume_parameter = 0.0;  ///< the volume's scattering over its absorption cross-section
};

/// The exponent of the roughness spectrum of all sea beds of the report.
inline constexpr double usual_exponent = 3.25;

/// The sea bed of a mean grain size in phi, -10 to 9, by the regressions of the report: from -1 on
/// those of sediments. Between -1 (sandy gravel), -7 (cobble), and -9.99 (rock) values are
/// interpolated; below -9.9999 it is rough rock.
SeaBed sea_bed_of_grain_size(double phi);

/// True if the material is a sea bed, and so has either a grain size or the other numbers.
bool is_sea_bed(const Material& material);
/// The sea bed of a material. `material` must be one.
SeaBed sea_bed_of(const Material& material, const Water& water);

/// Backscattering from a sea bed at one frequency: sigma per area and solid angle, whose 10 log is
/// the backscattering strength. Grazing angles are in rad, 0 to pi / 2.
class SeafloorScattering {
  public:
    /// `wavenumber` is that of the water, 2 pi f / c, in rad/m.
    SeafloorScattering(const SeaBed& bed, double wavenumber);

    /// Small roughness on the slopes of larger roughness, and the volume of the sediment.
    double diffuse(double grazing_rad) const;
    /// The Kirchhoff integral, near normal incidence.
    double specular(double grazing_rad) const;
    /// The part of diffuse() that comes from the volume of the sediment.
    double below(double grazing_rad) const;
    /// The mean range behind the surface, m, from which that part arrives (SedimentScattering).
    double lag_m(double grazing_rad) const;
    /// The power reflection coefficient at normal incidence.
    double reflection() const { return reflection_; }

  private:
    /// In the sediment, as a ratio to the wave number in the water.
    std::complex<double> vertical_wavenumber(double sine) const;
    double kirchhoff(double grazing_rad) const;
    double perturbation(double grazing_rad) const;
    double composite(double grazing_rad) const;
    double volume(double grazing_rad) const;
    /// The share of the Kirchhoff integral at its joint with `composite`.
    double share(double grazing_rad) const;
    /// The share of the surface not in the shadow of its own slopes (report, Eq. 43 to 45).
    double unshadowed_share(double grazing_rad) const;

    SeaBed bed_;
    double wavenumber_;
    std::complex<double> index2_;  ///< squared ratio of the wave numbers in sediment and water
    double reflection_;
    double slope_;            ///< RMS slope along a line of the roughness that is resolved
    double shadowing_slope_;  ///< RMS slope over a wavelength, by the report
    /// Kirchhoff's integral is peak / (cos^(4 alpha) + flatness sin^4)^power.
    double alpha_, peak_, flatness_, power_;
    double joint_rad_ = 0.0;  ///< grazing angle where the two parts join
};

}  // namespace sonarsim
