#include "fem/element.hpp"

namespace flowslide::fem {

Elements make_elements(const Model& model, const std::vector<std::int32_t>& order) {
  const std::size_t n = order.size();
  Elements r;
  for (auto* four : {&r.bx, &r.by, &r.gamma, &r.share})
    for (auto& v : *four) v.resize(n);
  for (auto* v : {&r.area, &r.volume, &r.hss, &r.hst, &r.htt}) v->resize(n);
  constexpr std::array<double, 4> kXi{-1, 1, 1, -1}, kEta{-1, -1, 1, 1}, kHour{1, -1, 1, -1};
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t e = order[k];
    const std::array<Vec2, 4> q = corners(model.mesh, model.mesh.nodes, e);
    // x = sum over x_i (1 + xi xi_i)(1 + eta eta_i)/4: derivatives at the centre and the xi eta
    // term
    double x_xi = 0, x_eta = 0, y_xi = 0, y_eta = 0, hx = 0, hy = 0;
    for (int i = 0; i < 4; ++i) {
      x_xi += 0.25 * kXi[i] * q[i][0];
      x_eta += 0.25 * kEta[i] * q[i][0];
      y_xi += 0.25 * kXi[i] * q[i][1];
      y_eta += 0.25 * kEta[i] * q[i][1];
      hx += kHour[i] * q[i][0];
      hy += kHour[i] * q[i][1];
    }
    const double J0 = x_xi * y_eta - x_eta * y_xi;
    // the Jacobian is J0 + 3 J1 xi + 3 J2 eta
    const double J1 = (x_xi * hy - y_xi * hx) / 12.0;
    const double J2 = (hx * y_eta - hy * x_eta) / 12.0;
    const double xi_x = y_eta / J0, xi_y = -x_eta / J0, eta_x = -y_xi / J0, eta_y = x_xi / J0;
    const double thickness = model.thickness[e];
    r.area[k] = 4.0 * J0;
    r.volume[k] = 4.0 * J0 * thickness;
    for (int i = 0; i < 4; ++i) {
      r.bx[i][k] = 0.25 * (kXi[i] * xi_x + kEta[i] * eta_x);
      r.by[i][k] = 0.25 * (kXi[i] * xi_y + kEta[i] * eta_y);
    }
    for (int i = 0; i < 4; ++i) {
      r.gamma[i][k] = 0.25 * (kHour[i] - hx * r.bx[i][k] - hy * r.by[i][k]);
      r.share[i][k] = (J0 + J1 * kXi[i] + J2 * kEta[i]) / (4.0 * J0);
    }
    const double moment = 4.0 / 3.0 * J0 * thickness;
    r.hss[k] = moment * (xi_x * xi_x + eta_x * eta_x);
    r.hst[k] = moment * (xi_x * xi_y + eta_x * eta_y);
    r.htt[k] = moment * (xi_y * xi_y + eta_y * eta_y);
  }
  return r;
}

}  // namespace flowslide::fem
