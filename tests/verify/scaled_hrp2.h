#pragma once

#include <filesystem>

namespace halfstep {

/// Makes HRP-2 in a folder another size, with lengths times `size` and what follows from that by
/// dynamic similarity: masses go by size³, inertias by size⁵, torques by size⁴, speeds of joints by
/// 1/√size.
void ScaleHrp2(const std::filesystem::path& folder, double size);
/// Gives every leg joint of HRP-2 in a folder an effort of 200 N·m: its own are not published.
void GiveHrp2Efforts(const std::filesystem::path& folder);

}  // namespace halfstep
