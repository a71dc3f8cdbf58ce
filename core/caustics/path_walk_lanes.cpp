// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/caustics/path_walk_lanes.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/caustics/path_walk_lanes.h"

#include "core/caustics/surface_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybray::caustics {
namespace HWY_NAMESPACE {

void meet_triangles(const optics::OpticsTable& optics, const WalkOptions& options, const PathFront& from,
                    PathFront& to, Arrivals& arrivals, LeftPaths& left, WalkCounts& counts) {
  const D d;
  const DU du;
  const DF df;
  const size_t lanes = hn::Lanes(d);
  const SurfaceTable& table = optics.surfaces;
  const V zero = hn::Zero(d);
  const VU none = hn::Set(du, uint64_t{kNoPrimitive}), triangles = hn::Set(du, table.entries().size());
  const VU low = hn::Set(du, path_tag::kMedium);
  LedgerLanes ledger;
  using Term = LedgerLanes;

  StagedTriangles stages[2] = {};
  if (from.count > 0) stages[0].stage(table, from, 0, lanes);
  for (size_t i = 0; i < from.count; i += lanes) {
    prefetch(table, from, i, lanes);
    const StagedTriangles& staged = stages[i / lanes % 2];
    stages[1 - i / lanes % 2].stage(table, from, i + lanes, lanes);
    const VU any_primitive = hn::PromoteTo(du, hn::Load(DF32U(), &from.hits.primitive[i]));
    const M here = hn::FirstN(d, from.count - i);
    const M misses = hn::And(here, hn::RebindMask(d, hn::Eq(any_primitive, none)));
    const M valid = hn::And(here, hn::RebindMask(d, hn::Lt(any_primitive, triangles)));
    Vec3 weight{hn::Load(d, &from.red[i]), hn::Load(d, &from.green[i]), hn::Load(d, &from.blue[i])};
    ledger.add(Term::escaped, i, misses, mean(weight));
    M leave = hn::AndNot(hn::Or(valid, misses), here);

    if (!hn::AllFalse(d, valid)) {
      const VU primitive = hn::IfThenElseZero(hn::RebindMask(du, valid), any_primitive);
      const auto& rays = from.rays;
      const Vec3f direction_f = load(&rays.dx[i], &rays.dy[i], &rays.dz[i]);
      const Vec3 direction = promoted(direction_f);
      const V t = hn::PromoteTo(d, hn::Load(df, &from.hits.t[i]));
      const Vec3 hit = add(promoted(load(&rays.ox[i], &rays.oy[i], &rays.oz[i])), scale(t, direction));
      const Surface surface = surface_at(staged, hn::Load(df, &from.hits.u[i]), hn::Load(df, &from.hits.v[i]),
                                         hit, direction, options.leaving);
      const Materials materials(optics.materials, surface.material, valid);
      const VU surface_bits = materials(&Optics::tag), tag = hn::Load(du, &from.tag[i]);
      const VU medium = hn::And(hn::ShiftRight<path_tag::kMediumShift>(tag), low);
      const V length = hn::Add(hn::Load(d, &from.length[i]), t);
      V absorbed = zero;
      if (!hn::AllTrue(d, hn::Or(hn::RebindMask(d, hn::Eq(medium, hn::Zero(du))), hn::Not(valid)))) {
        const Vec3 kept = through_medium(Media(optics.media, hn::BitCast(DI(), medium), valid), t, weight);
        absorbed = hn::Sub(mean(weight), mean(kept));
        weight = kept;
      }
      const V arriving = mean(weight);
      const M specular = hn::And(valid, flag(surface_bits, optics::surface_tag::kSpecular));
      M live = valid;
      V base_entry, specular_sum = zero;
      M goes_on = hn::FirstN(d, 0);
      Vec3 out_direction = direction, out_weight = weight, out_origin = hit;
      VU out_tag = tag;

      if (hn::AllFalse(d, specular)) {
        base_entry = materials(&Optics::base);
      } else {
        const Shares shares = shares_of(materials, surface_bits, specular, surface, weight);
        base_entry = shares.base_entry;
        const V back = mean(shares.back), through = mean(shares.through);
        specular_sum = hn::Add(back, through);
        const VU events = hn::And(tag, hn::Set(du, path_tag::kEvents));
        const M some = hn::And(specular, hn::Gt(specular_sum, zero));
        const M may_go =
            hn::RebindMask(d, hn::Lt(events, hn::Set(du, static_cast<uint64_t>(options.max_events))));
        const M candidates = hn::And(some, may_go);
        const M cut = hn::AndNot(may_go, some);

        const VU dimension = hn::Add(hn::Set(du, uint64_t{kFirstWalkDimension}), hn::Add(events, events));
        const VU stream = hybray::HWY_NAMESPACE::random_stream(hn::Load(du, &from.number[i]), options.seed);
        const V choice = hybray::HWY_NAMESPACE::random_unit(d, stream, dimension);
        const M mirrored = hn::Lt(hn::Mul(choice, specular_sum), back);
        const V chosen = hn::IfThenElse(mirrored, back, through);
        const V gain = hn::Div(specular_sum, chosen);
        out_weight = scale(gain, select(mirrored, shares.back, shares.through));

        const M thin = flag(surface_bits, optics::surface_tag::kThin);
        const M bends = hn::AndNot(hn::Or(mirrored, thin), candidates);
        const Vec3 bent = optics::HWY_NAMESPACE::refracted(direction, surface.shading, surface.cos_incident,
                                                           shares.inverse_eta, shares.eta_cos);
        const M plain = hn::And(hn::Gt(shares.eta_cos, zero), hn::Lt(dot(bent, surface.geometric), zero));
        const M odd = hn::AndNot(plain, bends);
        leave = hn::Or(leave, odd);
        live = hn::AndNot(odd, valid);
        out_direction = select(mirrored, reflection(surface, direction), select(bends, bent, direction));
        const V step = hn::IfThenElse(mirrored, surface.offset, hn::Neg(surface.offset));
        out_origin = add(surface.position, scale(step, surface.geometric));

        V after = specular_sum;
        M survives = candidates;
        const V wanted = hn::Mul(hn::Set(d, options.roulette_threshold), hn::Load(d, &from.initial[i]));
        const M gambles = hn::And(candidates, hn::Lt(specular_sum, wanted));
        if (!hn::AllFalse(d, gambles)) {
          const V luck =
              hybray::HWY_NAMESPACE::random_unit(d, stream, hn::Add(dimension, hn::Set(du, uint64_t{1})));
          const M lost = hn::AndNot(hn::Lt(hn::Mul(luck, wanted), specular_sum), gambles);
          survives = hn::AndNot(lost, candidates);
          const Vec3 raised = scale(hn::Div(wanted, specular_sum), out_weight);
          out_weight = select(gambles, raised, out_weight);
          after = hn::IfThenElse(gambles, hn::IfThenZeroElse(lost, mean(out_weight)), after);
        }
        goes_on = hn::And(survives, live);
        const M specular_live = hn::And(candidates, live);

        ledger.add(Term::truncated, i, hn::And(live, cut), specular_sum);
        ledger.add(Term::balance, i, specular_live, hn::Sub(specular_sum, after));

        // An interface that is crossed leads into the medium of its other side.
        const VU inner = hn::And(hn::ShiftRight<optics::surface_tag::kInnerShift>(surface_bits), low);
        const VU outer = hn::And(hn::ShiftRight<optics::surface_tag::kOuterShift>(surface_bits), low);
        const auto from_inner = hn::RebindMask(du, surface.from_inner);
        const M interface = hn::And(live, flag(surface_bits, optics::surface_tag::kInterface));
        const auto wrong = hn::Ne(medium, hn::IfThenElse(from_inner, inner, outer));
        counts.medium_mismatches += hn::CountTrue(d, hn::And(interface, hn::RebindMask(d, wrong)));
        const VU beyond =
            hn::IfThenElse(hn::RebindMask(du, bends), hn::IfThenElse(from_inner, outer, inner), medium);
        out_tag = hn::Or(hn::AndNot(hn::ShiftLeft<path_tag::kMediumShift>(low), tag),
                         hn::ShiftLeft<path_tag::kMediumShift>(beyond));
        out_tag = hn::Add(out_tag, hn::Set(du, uint64_t{1}));
      }

      const V entry = hn::IfThenElseZero(flag(surface_bits, optics::surface_tag::kDiffuse),
                                         hn::Mul(arriving, base_entry));
      const M enters = hn::And(live, hn::Gt(entry, zero));
      const M first = hn::RebindMask(d, hn::Eq(hn::And(tag, hn::Set(du, path_tag::kEvents)), hn::Zero(du)));
      ledger.add(Term::direct, i, hn::And(enters, first), entry);
      ledger.add(Term::deposited, i, hn::AndNot(first, enters), entry);
      ledger.add(Term::absorbed, i, live, hn::Add(absorbed, hn::Sub(hn::Sub(arriving, entry), specular_sum)));

      const Packed arriving_lanes(hn::AndNot(first, enters));
      if (arriving_lanes.count() > 0)
        arrive(arriving_lanes, surface, direction_f, weight, length, tag, primitive, arrivals);
      const Packed going(goes_on);
      if (going.count() > 0) {
        const size_t at = to.count;
        going.store(demoted(out_origin), &to.rays.ox[at], &to.rays.oy[at], &to.rays.oz[at]);
        going.store(demoted(out_direction), &to.rays.dx[at], &to.rays.dy[at], &to.rays.dz[at]);
        going.store(out_weight.x, &to.red[at]);
        going.store(out_weight.y, &to.green[at]);
        going.store(out_weight.z, &to.blue[at]);
        going.store(hn::Load(d, &from.initial[i]), &to.initial[at]);
        going.store(length, &to.length[at]);
        going.store(hn::Load(du, &from.number[i]), &to.number[at]);
        going.store(out_tag, &to.tag[at]);
        to.count += going.count();
      }
    }

    if (HWY_UNLIKELY(!hn::AllFalse(d, leave))) {
      const Packed odd(leave);
      odd.store(hn::TruncateTo(DF32U(), hn::Iota(du, i)), &left.index[left.count]);
      left.count += odd.count();
    }
  }

  counts.ledger.deposited += ledger.total(Term::deposited);
  counts.ledger.direct += ledger.total(Term::direct);
  counts.ledger.absorbed += ledger.total(Term::absorbed);
  counts.ledger.escaped += ledger.total(Term::escaped);
  counts.ledger.truncated += ledger.total(Term::truncated);
  counts.ledger.balance += ledger.total(Term::balance);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::caustics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray::caustics {

HWY_EXPORT(meet_triangles);

void meet_triangles(const optics::OpticsTable& optics, const WalkOptions& options, const PathFront& from,
                    PathFront& to, Arrivals& arrivals, LeftPaths& left, WalkCounts& counts) {
  HWY_DYNAMIC_DISPATCH(meet_triangles)(optics, options, from, to, arrivals, left, counts);
}

}  // namespace hybray::caustics
#endif
