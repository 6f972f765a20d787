#pragma once

#include <vector>

#include "wpg/files/fields.h"
#include "wpg/files/key_description.h"

namespace halfstep {

/// Complains of keys at the root of a document that are keys of its groups only, with the paths
/// that may be meant: "methods: belongs into a group (valid: smoothing.methods)". `keys`: all of
/// the document's. To be called after what declares them.
void RefuseKeysOfGroups(Fields& fields, const std::vector<KeyDescription>& keys);

}  // namespace halfstep
