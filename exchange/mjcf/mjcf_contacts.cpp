#include "mjcf_contacts.hpp"

#include <algorithm>
#include <set>

namespace plumbline {
namespace {

// Cone dimensions: 1 no friction, 3 sliding, 4 also turning on the spot, 6 also rolling.
constexpr int kSliding = 3;

struct Law {
  int dimension;
  double friction;
};

// Of two shapes the one of higher priority, else the larger of both.
Law law_of(const mjModel& m, int g1, int g2) {
  const int p1 = m.geom_priority[g1], p2 = m.geom_priority[g2];
  const auto of = [&](int g) { return Law{m.geom_condim[g], m.geom_friction[3 * g]}; };
  if (p1 != p2) return of(p1 > p2 ? g1 : g2);
  return {std::max(m.geom_condim[g1], m.geom_condim[g2]), std::max(of(g1).friction, of(g2).friction)};
}

bool masks_match(const mjModel& m, int g1, int g2) {
  return (m.geom_contype[g1] & m.geom_conaffinity[g2]) != 0 || (m.geom_contype[g2] & m.geom_conaffinity[g1]) != 0;
}

// What MuJoCo leaves out before it looks at shapes: one rigid whole, parents with children unless the parent stands
// still, and pairs that the file excludes.
bool bodies_filtered(const mjModel& m, int b1, int b2) {
  const int w1 = m.body_weldid[b1], w2 = m.body_weldid[b2];
  if (w1 == w2) return true;
  const int above1 = m.body_weldid[m.body_parentid[w1]], above2 = m.body_weldid[m.body_parentid[w2]];
  if ((m.opt.disableflags & mjDSBL_FILTERPARENT) == 0 && w1 != 0 && w2 != 0 && (w1 == above2 || w2 == above1))
    return true;
  const auto signature = [](int x, int y) { return ((x + 1) << 16) + y + 1; };
  return std::any_of(m.exclude_signature, m.exclude_signature + m.nexclude,
                     [&](int s) { return s == signature(b1, b2) || s == signature(b2, b1); });
}

}  // namespace

bool may_collide(const mjModel& m, int geom) {
  if (m.geom_contype[geom] != 0 || m.geom_conaffinity[geom] != 0) return true;
  for (int p = 0; p < m.npair; ++p) {
    if (m.pair_geom1[p] == geom || m.pair_geom2[p] == geom) return true;
  }
  return false;
}

void add_contacts(const CompiledModel& model, const std::vector<std::size_t>& link_of_body, double restitution,
                  WorldDraft& draft) {
  const mjModel& m = model.m();
  if ((m.opt.disableflags & (mjDSBL_CONTACT | mjDSBL_CONSTRAINT)) != 0) return;
  std::set<int> turning;
  const auto add = [&](int g1, int g2, const Law& law) {
    const std::size_t a = link_of_body[static_cast<std::size_t>(m.geom_bodyid[g1])];
    const std::size_t b = link_of_body[static_cast<std::size_t>(m.geom_bodyid[g2])];
    if (a == b || (draft.links[a].fixed && draft.links[b].fixed)) return;
    if (law.dimension > kSliding && turning.insert(law.dimension).second) {
      draft.losses.push_back("friction against turning or rolling (condim " + std::to_string(law.dimension) +
                             "); contacts of a scenario have sliding friction only");
    }
    draft.contacts.push_back({a, b, {restitution, law.dimension == 1 ? 0 : law.friction}});
  };
  std::set<std::pair<int, int>> listed;
  if (m.opt.collision != mjCOL_DYNAMIC) {
    for (int p = 0; p < m.npair; ++p) {
      listed.insert(std::minmax(m.pair_geom1[p], m.pair_geom2[p]));
      add(m.pair_geom1[p], m.pair_geom2[p], {m.pair_dim[p], m.pair_friction[5 * p]});
    }
  }
  if (m.opt.collision == mjCOL_PAIR) return;
  for (int g2 = 0; g2 < m.ngeom; ++g2) {
    for (int g1 = 0; g1 < g2; ++g1) {
      if (listed.contains({g1, g2}) || !masks_match(m, g1, g2)) continue;
      if (!bodies_filtered(m, m.geom_bodyid[g1], m.geom_bodyid[g2])) add(g1, g2, law_of(m, g1, g2));
    }
  }
}

}  // namespace plumbline
