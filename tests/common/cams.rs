//! Cams told otherwise.

use linkdyn_model::{Cam, CamSegment, Profile};

/// A cam behind the mirror: it goes through its turn the other way round.
pub fn mirror_cam(cam: &mut Cam) {
    let mirrored = |[x, y]: [f64; 2]| [-x, y];
    // the cam stays to the right of the face
    cam.face = cam.face.map(|[x, y]| [x, -y]);
    let reversed = |begin: &mut f64, segments: &mut Vec<CamSegment>, sign: f64| {
        let span: f64 = segments.iter().map(CamSegment::span).sum();
        *begin = -(*begin + span);
        segments.reverse();
        for segment in segments {
            segment.rise = segment.rise.map(|rise| sign * rise);
        }
    };
    match &mut cam.profile {
        Profile::Circle { centre, .. } => *centre = mirrored(*centre),
        Profile::Points { points } => points
            .iter_mut()
            .for_each(|point| *point = mirrored(*point)),
        Profile::Law {
            axis,
            offset,
            begin,
            segments,
            ..
        } => {
            *axis = axis.map(mirrored);
            *offset = -*offset;
            reversed(begin, segments, -1.0);
        }
        Profile::Swing {
            axis,
            angle,
            begin,
            segments,
            ..
        } => {
            *axis = mirrored(*axis);
            *angle = -*angle;
            reversed(begin, segments, 1.0);
        }
    }
}
