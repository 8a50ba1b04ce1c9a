/// Collects all loads on one body: what enters at which port, by which effect, in the body's frame. It
/// keeps the sum of forces and moments of every effect, so that statics can find the reactions, and turns
/// what was entered into channels and unit loads.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_load.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/scene/values/body_options.h"
#include "pipelines/scene/values/pressure_pattern.h"

namespace pipelines {

/// Cells that count their mass together, and what they weigh.
struct RegionMass {
  std::string name;             ///< "structure"; empty: the whole body
  std::vector<int> volume_ids;  ///< empty: the whole body
  fem::MassProperties masses;   ///< about the origin of the body's frame
};

/// A body as distribution sees it.
struct LoadedBody {
  std::string name;  ///< "shaft", "chamber" ...
  std::vector<meshes::Port> ports;
  std::vector<RegionMass> regions;  ///< at least one
  /// Pressures by port; a half-cosine to the fourth harmonic where missing.
  std::map<std::string, PressureModel> pressures;
  double plane_modulus_Pa = 0;  ///< E / (1 - nu^2), for contact with clearance

  /// @throws std::out_of_range naming the region
  const RegionMass& region(const std::string& region_name = "") const;
};

/// d'Alembert's field  a(p) = translation + angular z x p + spin (x, y, 0)  over the instants, by rows.
struct AccelerationField {
  Eigen::Array3Xd translation_m_s2;  ///< x, y, z; no columns: none
  Eigen::ArrayXd angular_rad_s2;     ///< counter-clockwise; empty: none
  Eigen::ArrayXd spin_rad2_s2;       ///< squared speed; empty: none
};

/// A body's loads: channels over time and, in the same order, their unit loads.
struct BodyLoads {
  ChannelHistory history;
  std::vector<fem::UnitLoad> unit_loads;
  std::map<std::string, PressureModel> pressures;  ///< by port that a pressure loads; half angles known
  /// Force that presses there, by such a port: what turns the pressure's harmonics.
  std::map<std::string, Eigen::Array2Xd> pressing_force_N;
  /// Vibratory shaft: what the bearings carry, own mass included; fixed frame.
  Eigen::Array2Xd frame_bearing_force_N;
  Eigen::ArrayXd drive_torque_Nm;  ///< vibratory shaft: clockwise positive, own mass included
  /// Moment that a named guide (`pitch_guide`) carries, counter-clockwise; empty: none.
  Eigen::ArrayXd carried_moment_Nm;
  double carried_moment_scale_Nm = 0;  ///< the sum of the moments' sizes that it is judged by
};

/// Rows fx, fy, fz [N], mx, my, mz [N m] about the origin; a column per instant.
using Wrench = Eigen::Array<double, 6, Eigen::Dynamic>;

class LoadCollector {
public:
  /// @param force_scale_N  a typical force: what stays below 1e-13 of it is round-off, and no channel
  LoadCollector(const LoadedBody& body, std::vector<std::string> effects, Eigen::Index n_instants,
                double force_scale_N);

  /// The index of an effect, a new one if there is none of that name: what the body itself brings.
  std::size_t effect(const std::string& name);

  // Loads that an effect, by its index, brings at a port, in the body's frame. Force through the port's own
  // point, or beside it along z where the axial profile of its pressure has its middle; moments about the
  // port's own point.
  // @throws StageRefused if the body has no such port
  void force(const std::string& port_name, std::size_t effect, const Eigen::Array2Xd& force_N);
  void axial_force(const std::string& port, std::size_t effect, const Eigen::ArrayXd& force_N);
  void torque(const std::string& port, std::size_t effect, const Eigen::ArrayXd& moment_Nm);
  void tilt(const std::string& port_name, std::size_t effect, const Eigen::Array2Xd& moment_Nm);

  /// Harmonics of the pressure that the forces entered at the port so far make, by the port's model. They
  /// carry |F| cos(n beta), which is not linear in the effects; effect e gets the share F_e . F/|F|, so that
  /// the shares add up exactly. With a clearance the half angle is that under the largest force.
  void pressure(const std::string& port_name);

  void accelerate(const RegionMass& region, std::size_t effect, const AccelerationField& field);
  void accelerate(const AttachedMass& mass, std::size_t effect, const AccelerationField& field);

  /// Sum of what an effect has brought so far; zero for one that has brought nothing.
  Wrench sum(std::size_t effect) const;
  Wrench sum() const;
  /// max over the instants of the sum of the moments' sizes about z: |x F_y| + |y F_x| + |couple| of what
  /// enters at each place, the effects taken together.
  double moment_scale_Nm() const;
  std::vector<std::string> effects() const { return effects_; }

  /// Bearing forces at two ports by statics, effect by effect, moments about the first one's centre of
  /// pressure. Where `resultant` holds an effect, that is the sum of its two reactions (and closing is then
  /// up to the load stage); elsewhere they balance what was collected.
  void react(const std::string& first, const std::string& second,
             const std::map<std::size_t, Eigen::Array2Xd>& resultant = {});
  // Whatever is left of that component about the port's own point, with the opposite sign, effect by effect.
  void react_force(const std::string& port);
  void react_axial(const std::string& port);
  void react_torque(const std::string& port);
  void react_tilt(const std::string& port);

  BodyLoads finish() const;

private:
  struct Entry {
    fem::UnitLoad load;
    std::string unit;
    std::map<std::size_t, Eigen::ArrayXd> parts;  // by effect
  };
  const meshes::Port& find(const std::string& port_name) const;
  double pressed_beside_m(const meshes::Port& port) const;
  fem::LoadSurface surface_of(const meshes::Port& port) const;
  void enter(const meshes::Port& port, const char* component, fem::SurfaceResultant::Component which,
             std::size_t effect, const Eigen::ArrayXd& values);
  void add(const fem::UnitLoad& load, const std::string& unit, std::size_t effect,
           const Eigen::ArrayXd& values, double scale);
  /// @param load  about the point
  void count(const std::string& place, std::size_t effect, const Eigen::Vector3d& point, const Wrench& load);

  LoadedBody body_;
  std::vector<std::string> effects_;
  Eigen::Index n_instants_;
  double force_scale_N_, length_scale_m_;
  std::vector<Entry> channels_;
  std::map<std::string, std::size_t> index_;
  std::map<std::size_t, Wrench> sums_;                                    // by effect
  std::map<std::string, std::map<std::size_t, Eigen::Array2Xd>> forces_;  // by port, effect
  std::map<std::string, Eigen::Array3Xd> moments_Nm_;                     // by place: x F_y, y F_x, couple
  std::map<std::string, PressureModel> pressures_;                        // by port
  std::map<std::string, Eigen::Array2Xd> pressing_force_N_;               // by port
};

/// Resolves a planar force along axes that are turned counter-clockwise by alpha.
Eigen::Array2Xd turned(const Eigen::Array2Xd& force, const Eigen::ArrayXd& alpha_rad);

/// Point where a port's load acts: on its axis, in the middle.
Eigen::Vector3d centre_of(const meshes::Port& port);

}  // namespace pipelines
