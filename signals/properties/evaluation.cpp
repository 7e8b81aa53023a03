#include "signals/properties/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/text/text.hpp"

namespace skein::properties {
namespace {

using Outcome = Verdict::Outcome;
using Kind = Property::Kind;

/// The values of a property's signals: one row per exchange, one column per slot.
class Rows {
 public:
  Rows(const Property& property, RunSignals& run) : width_(property.signals.size()), size_(run.exchanges()), run_(run) {
    values_.resize(width_ * size_);
    for (std::size_t slot = 0; slot < width_; ++slot) {
      const std::vector<double>& signal = run.values(property.signals[slot]);
      for (std::size_t k = 0; k < size_; ++k) values_[k * width_ + slot] = signal[k];
    }
  }

  std::size_t size() const { return size_; }
  std::span<const double> row(std::size_t k) const { return std::span(values_).subspan(k * width_, width_); }
  Instant at(std::size_t k, std::size_t anchor) const { return {row(k), row(k == 0 ? 0 : k - 1), row(anchor)}; }

  /// Whether any signal but `time` and `result` changed between the exchanges `first` and `last`; true if there is no
  /// other signal.
  bool any_moved(const Property& property, std::size_t first, std::size_t last) const {
    bool can_move = false;
    for (std::size_t slot = 0; slot < width_; ++slot) {
      const SignalUse& signal = property.signals[slot];
      if (signal.is("time") || signal.is("result")) continue;
      can_move = true;
      for (std::size_t k = first + 1; k <= last; ++k) {
        if (row(k)[slot] != row(first)[slot]) return true;
      }
      if (signal.is("alive") && flew(signal.argument(0), first, last)) return true;
    }
    return !can_move;
  }

 private:
  /// Whether a UAV flew. `alive` changes only in a collision, but a UAV that flies exercises it, too.
  bool flew(const std::string& uav, std::size_t first, std::size_t last) const {
    const auto& table = signal_table();
    const auto distance = std::ranges::find(table, std::string_view("distance"), &SignalInfo::name);
    const std::vector<double>& way = run_.values({&*distance, {uav}});
    return way[last] > way[first];
  }

  const std::size_t width_, size_;
  RunSignals& run_;
  std::vector<double> values_;
};

/// Whether a condition says that something keeps a certain value: `gain(captures) == 0`. Then a run in which nothing
/// changes does say something about it.
bool says_still(const Expression& condition) {
  const bool is_still = condition.op == Expression::Op::equal && !is_constant(condition) &&
                        std::ranges::any_of(condition.parts, is_constant);
  return is_still || std::ranges::any_of(condition.parts, says_still);
}

/// Exchanges [first, last] in which a property is evaluated.
struct Stretch {
  std::size_t first = 0, last = 0;
  bool is_whole = true;  ///< false: the run ended, or `unless` came, before the window's end
};

/// A margin and the exchange that decided it.
struct Decision {
  Margin margin;
  std::size_t at = 0;
};

class Evaluation {
 public:
  Evaluation(const Property& property, RunSignals& run)
      : property_(property), run_(run), rows_(property, run), period_s_(run.period_s()) {}

  Verdict verdict() {
    if (rows_.size() == 0) return vacuous("the run has no exchange");
    if (property_.window.from == Window::From::heal && !run_.healed_s()) {
      return vacuous("a fault lasts to the end of the run, so there is no time after it");
    }
    const auto whole = stretch(begin_s());
    if (!whole)
      return vacuous("the run ended at " + number_text(end_s()) + " s, before " + number_text(begin_s()) + " s");
    const std::vector<std::size_t> starts = property_.whenever ? triggers(*whole) : std::vector{whole->first};
    if (starts.empty() && unclear_s_) return unclear("'whenever'");
    if (starts.empty()) return vacuous("the condition of 'whenever' never became true");
    Verdict worst;
    bool decided = false;
    for (const std::size_t start : starts) {
      const Stretch part = property_.whenever ? from_trigger(start, *whole) : *whole;
      const std::optional<Verdict> one = judge(part);
      if (!one) continue;
      if (!decided || one->margin < worst.margin ||
          (one->outcome == Outcome::fails && worst.outcome != Outcome::fails)) {
        worst = *one;
      }
      decided = true;
    }
    if (unclear_s_ && worst.outcome != Outcome::fails) {
      return unclear("it");
    }
    if (!decided && excused_) return vacuous("it was not exercised: the condition of 'unless' became true first");
    if (!decided) return vacuous("the run ended before it could be decided");
    if (property_.kind == Kind::sometimes && worst.outcome == Outcome::fails) return vacuous("it was never reached");
    if (worst.outcome == Outcome::holds && !says_still(property_.condition) &&
        !rows_.any_moved(property_, whole->first, whole->last)) {
      return vacuous("none of its signals ever changed");
    }
    return worst;
  }

 private:
  double time_of(std::size_t k) const { return static_cast<double>(k) * period_s_; }
  double end_s() const { return time_of(rows_.size() - 1); }
  std::size_t exchange_at(double time_s) const {
    return static_cast<std::size_t>(std::ceil(time_s / period_s_ - 1e-6));
  }

  double begin_s() const {
    switch (property_.window.from) {
      case Window::From::start:
        return 0.0;
      case Window::From::heal:
        return *run_.healed_s();
      case Window::From::time:
        return property_.window.from_s;
    }
    return 0.0;
  }

  /// The exchanges of the window that begins at `from_s`. @returns nullopt if it begins after the run's end.
  std::optional<Stretch> stretch(double from_s) const {
    const std::size_t first = exchange_at(from_s);
    if (first >= rows_.size()) return std::nullopt;
    std::optional<double> until_s = property_.window.until_s;
    if (property_.window.within_s && !property_.whenever) {
      const double deadline_s = from_s + *property_.window.within_s;
      until_s = std::min(until_s.value_or(deadline_s), deadline_s);
    }
    if (!until_s) return Stretch{first, rows_.size() - 1};
    const auto last = static_cast<std::size_t>(std::floor(*until_s / period_s_ + 1e-6));
    return Stretch{first, std::max(first, std::min(last, rows_.size() - 1)), last < rows_.size()};
  }

  Stretch from_trigger(std::size_t start, const Stretch& whole) const {
    if (!property_.window.within_s) return {start, whole.last, whole.is_whole};
    const auto last = start + static_cast<std::size_t>(std::floor(*property_.window.within_s / period_s_ + 1e-6));
    return {start, std::min(last, rows_.size() - 1), last < rows_.size()};
  }

  /// Exchanges in which `whenever` becomes true.
  std::vector<std::size_t> triggers(const Stretch& whole) {
    std::vector<std::size_t> starts;
    bool before = false;
    for (std::size_t k = whole.first; k <= whole.last; ++k) {
      const Margin trigger = margin_at(*property_.whenever, rows_.at(k, whole.first));
      if (!trigger.is_defined) note_unclear(k);
      const bool now = trigger.holds;
      if (now && !before) starts.push_back(k);
      before = now;
    }
    return starts;
  }

  /// Records that the property is undefined in exchange k, and nothing else decides it.
  void note_unclear(std::size_t k) { unclear_s_ = std::min(unclear_s_.value_or(time_of(k)), time_of(k)); }

  /// The first exchange in which the condition of `unless` is true; nullopt: none.
  std::optional<std::size_t> excuse(const Stretch& part) const {
    if (!property_.unless) return std::nullopt;
    for (std::size_t k = part.first; k <= part.last; ++k) {
      if (margin_at(*property_.unless, rows_.at(k, part.first)).holds) return k;
    }
    return std::nullopt;
  }

  /// @returns nullopt if the property is undefined, or the run ended or `unless` came before it was decided.
  std::optional<Verdict> judge(Stretch part) {
    if (const std::optional<std::size_t> at = excuse(part)) {
      excused_ = true;
      if (*at == part.first) return std::nullopt;
      part = {part.first, *at - 1, false};
    }
    const Decision decision = decided(part);
    if (!decision.margin.is_defined) {
      note_unclear(decision.at);
      return std::nullopt;
    }
    const bool holds = decision.margin.holds;
    const bool may_come = property_.kind == Kind::eventually || property_.kind == Kind::until;
    const bool is_open = property_.kind == Kind::finally || (may_come && !holds);
    if (is_open && !part.is_whole) return std::nullopt;
    Verdict verdict;
    verdict.outcome = holds ? Outcome::holds : Outcome::fails;
    verdict.margin = decision.margin.margin;
    verdict.unit = property_.condition.unit;
    verdict.bound = property_.bound;
    verdict.at_s = time_of(decision.at);
    if (!holds) verdict.reason = failure(part, decision.at);
    return verdict;
  }

  std::string failure(const Stretch& part, std::size_t at) const {
    const std::string when = number_text(time_of(at)) + " s";
    const std::string stretch =
        "from " + number_text(time_of(part.first)) + " to " + number_text(time_of(part.last)) + " s";
    switch (property_.kind) {
      case Kind::always:
      case Kind::finally:
        return "it did not hold at " + when;
      case Kind::never:
        return "it held at " + when;
      case Kind::until:
        return "it did not hold until the other did, " + stretch;
      case Kind::sometimes:
      case Kind::eventually:
        return "it never held " + stretch;
    }
    return "";
  }

  Decision decided(const Stretch& part) const {
    if (property_.kind == Kind::until) return decided_until(part);
    if (property_.kind == Kind::finally) return {margin_here(part.last, part.first), part.last};
    const bool all = property_.kind == Kind::always || property_.kind == Kind::never;
    std::optional<Decision> result;
    for (std::size_t k = part.first; k <= part.last; ++k) {
      const Margin margin = margin_here(k, part.first);
      const bool decides = !result || (all ? worse(margin, result->margin) : worse(result->margin, margin));
      if (decides) result = Decision{margin, k};
    }
    return *result;
  }

  Decision decided_until(const Stretch& part) const {
    Margin so_far = certain(true);
    std::optional<Decision> result;
    for (std::size_t k = part.first; k <= part.last; ++k) {
      const Margin here = both(margin_at(property_.goal, rows_.at(k, part.first)), so_far);
      if (!result || worse(result->margin, here)) result = Decision{here, k};
      so_far = both(so_far, margin_at(property_.condition, rows_.at(k, part.first)));
    }
    return *result;
  }

  Margin margin_here(std::size_t k, std::size_t anchor) const {
    const Margin margin = margin_at(property_.condition, rows_.at(k, anchor));
    return property_.kind == Kind::never ? opposite(margin) : margin;
  }

  /// A false condition is worse than a true one, even if the margins of both are 0. An undefined one ranks between
  /// them, so that it decides only if nothing else does.
  static bool worse(const Margin& a, const Margin& b) {
    const auto rank = [](const Margin& margin) { return !margin.is_defined ? 1 : margin.holds ? 2 : 0; };
    return rank(a) != rank(b) ? rank(a) < rank(b) : a.margin < b.margin;
  }

  Verdict unclear(const std::string& what) const {
    Verdict verdict = vacuous("it cannot be judged, since " + what + " is undefined at " + number_text(*unclear_s_) +
                              " s: something is divided by 0 there, or two infinite numbers are compared");
    verdict.is_unclear = true;
    return verdict;
  }
  Verdict vacuous(const std::string& reason) const { return {.bound = property_.bound, .reason = reason}; }

  const Property& property_;
  RunSignals& run_;
  const Rows rows_;
  const double period_s_;
  std::optional<double> unclear_s_;  ///< first time at which the property was undefined, undecided by anything else
  bool excused_ = false;             ///< `unless` came at least once
};

}  // namespace

Verdict evaluate(const Property& property, RunSignals& run) { return Evaluation(property, run).verdict(); }

Verdict worst_of(const std::vector<Verdict>& verdicts) {
  const auto rank = [](const Verdict& verdict) {
    const int kind = verdict.outcome == Outcome::fails   ? 0
                     : verdict.is_unclear                ? 1
                     : verdict.outcome == Outcome::holds ? 2
                                                         : 3;
    return std::pair(kind, verdict.margin);
  };
  Verdict worst = *std::ranges::min_element(verdicts, {}, rank);
  const bool all_are_vacuous = worst.outcome == Outcome::vacuous && !worst.is_unclear;
  if (all_are_vacuous && verdicts.size() > 1) worst.bound.clear();
  return worst;
}

std::vector<double> margins_over_time(const Property& property, RunSignals& run) {
  const Rows rows(property, run);
  std::vector<double> margins;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Margin margin = margin_at(property.condition, rows.at(k, 0));
    margins.push_back(property.kind == Kind::never ? -margin.margin : margin.margin);
  }
  return margins;
}

}  // namespace skein::properties
