#include "wpg/files/number_visit.h"

#include <utility>

namespace halfstep {
namespace {

class NumberVisitor : public Fields {
 public:
  NumberVisitor(std::string prefix, const NumberVisit& visit)
      : prefix_(std::move(prefix)), visit_(visit) {}

  void Number(const char* key, double* value, const NumberSpec& spec) override {
    visit_(prefix_ + key, value, spec);
  }
  void OptionalNumber(const char* key, std::optional<double>* value,
                      const NumberSpec& spec) override {
    if (*value) Number(key, &**value, spec);
  }
  bool Group(const char* key, const GroupSpec&,
             const std::function<void(Fields&)>& declare) override {
    NumberVisitor group(prefix_ + key + ".", visit_);
    declare(group);
    return false;
  }
  void OptionalGroup(const char* key, bool*, const GroupSpec& spec,
                     const std::function<void(Fields&)>& declare) override {
    Group(key, spec, declare);
  }
  void Integer(const char*, int*, const NumberSpec&) override {}
  void Boolean(const char*, bool*, const TextSpec&) override {}
  void Text(const char*, std::string*, const TextSpec&) override {}
  void Texts(const char*, std::vector<std::string>*, const TextSpec&) override {}
  void Numbers(const char*, std::vector<double>*, size_t, const NumberSpec&) override {}
  void Points(const char*, Eigen::Matrix2Xd*, const GroupSpec&, const NumberSpec&) override {}
  void Items(const char*, const GroupSpec&, size_t, const std::function<void(size_t)>&,
             const std::function<void(Fields&, size_t)>&) override {}

 private:
  std::string prefix_;
  const NumberVisit& visit_;
};

}  // namespace

void VisitNumbers(const std::function<void(Fields&)>& declare, const NumberVisit& visit) {
  NumberVisitor visitor("", visit);
  declare(visitor);
}

}  // namespace halfstep
