#include "tests/picture/renderer.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <OpenImageIO/imagebuf.h>
#include <epoxy/gl.h>

#include "ig/eyepoint.hpp"
#include "tests/picture/value_or_throw.hpp"

namespace eyepoint::testing {

namespace {

/// Of the frame buffer bound for reading. Reverse-Z with the far plane at infinity: depth = near / distance.
std::vector<double> read_distances(ig::PictureSize size, double near_m) {
    const auto width = static_cast<std::size_t>(size.width_px),
               height = static_cast<std::size_t>(size.height_px);
    std::vector<float> depths(width * height);
    glReadPixels(0, 0, size.width_px, size.height_px, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    std::vector<double> distances(depths.size());
    for (std::size_t row = 0; row < height; ++row) {
        const float* from = depths.data() + (height - 1 - row) * width;
        std::transform(
            from, from + width, distances.begin() + static_cast<std::ptrdiff_t>(row * width),
            [near_m](float depth) { return depth > 0.0F ? near_m / static_cast<double>(depth) : 0.0; });
    }
    return distances;
}

}  // namespace

bool is_sentinel(const ig::Picture& picture, int x, int y) {
    const std::uint8_t* pixel =
        picture.rgba.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.width_px) +
                               static_cast<std::size_t>(x)) *
                                  ig::Picture::kBytesPerPixel;
    return pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 255;
}

ig::View view_of(const CameraPose& pose) {
    net::HostState state;
    state.entities[0] = {.latitude_deg = pose.place.latitude_deg,
                         .longitude_deg = pose.place.longitude_deg,
                         .altitude_m = pose.place.height_m,
                         .attitude = {pose.yaw_deg, pose.pitch_deg, pose.roll_deg}};
    ig::EyepointReading reading{
        .view = {}, .altitude_datum = config::VerticalDatum::Ellipsoid, .geoid = nullptr};
    reading.view.vertical_fov_deg = pose.vertical_fov_deg;
    return ig::eyepoint_of(state, reading, {pose.width_px, pose.height_px}).value().view;
}

Renderer::Renderer(std::shared_ptr<const terrain::Database> database, ig::PictureSize size,
                   const ig::SceneOptions& options)
    : context_(value_or_throw(ig::EglContext::create(false))),
      frame_buffer_(value_or_throw(ig::FrameBuffer::create(size))),
      scene_(value_or_throw(ig::Scene::create(std::move(database), options))) {}

DrawnPicture Renderer::draw_complete(const CameraPose& pose) {
    const ig::View view = view_of(pose);
    DrawnPicture drawn;
    scene_->load_all(view);
    drawn.statistics = draw_now(view, drawn.picture);
    drawn.distance_m = read_distances(frame_buffer_.size(), view.near_m);
    return drawn;
}

ig::Picture Renderer::draw_complete(const ig::View& view) {
    ig::Picture picture;
    scene_->load_all(view);
    draw_now(view, picture);
    return picture;
}

ig::FrameStatistics Renderer::draw_now(const ig::View& view, ig::Picture& picture) {
    frame_buffer_.bind();
    const ig::FrameStatistics statistics = scene_->draw(view);
    frame_buffer_.read(picture);
    return statistics;
}

DrawnPicture Renderer::draw_distances(const ig::View& view) {
    DrawnPicture drawn;
    drawn.statistics = draw_now(view, drawn.picture);
    drawn.distance_m = read_distances(frame_buffer_.size(), view.near_m);
    return drawn;
}

DrawnPicture Renderer::draw_floor(const ig::View& view) {
    DrawnPicture drawn;
    frame_buffer_.bind();
    scene_->draw_floor(view);
    frame_buffer_.read(drawn.picture);
    drawn.distance_m = read_distances(frame_buffer_.size(), view.near_m);
    return drawn;
}

DrawnPicture Renderer::draw_still(const ig::View& view) {
    DrawnPicture drawn;
    frame_buffer_.bind();
    scene_->keep_still(view);
    scene_->draw_still(view);
    frame_buffer_.read(drawn.picture);
    drawn.distance_m = read_distances(frame_buffer_.size(), view.near_m);
    return drawn;
}

ig::Picture Renderer::draw_over(const std::function<void()>& draw) {
    ig::Picture picture;
    frame_buffer_.bind();
    draw();
    frame_buffer_.read(picture);
    return picture;
}

void write_png(const ig::Picture& picture, const std::string& file) {
    const OIIO::ImageSpec spec(picture.size.width_px, picture.size.height_px, 3, OIIO::TypeDesc::UINT8);
    OIIO::ImageBuf image(spec);
    image.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::UINT8, picture.rgba.data(),
                     ig::Picture::kBytesPerPixel,
                     static_cast<OIIO::stride_t>(picture.size.width_px) * ig::Picture::kBytesPerPixel);
    if (!image.write(file)) throw std::runtime_error(image.geterror());
}

void keep_for_looking(const ig::Picture& picture, const std::string& name) {
    if (const char* folder = std::getenv("EYEPOINT_LOOK"))
        write_png(picture, std::string(folder) + "/" + name + ".png");
}

}  // namespace eyepoint::testing
