//! Scenes that have been checked, and are lowered to their phases once.

use std::mem::replace;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use serde::{Deserialize, Serialize};

use crate::error::SceneError;
use crate::phases::Phases;
use crate::scene::{Parameter, Scene};

/// A valid scene, which cannot be changed, with the phases that it is lowered to when they are first asked for. Clones
/// share them. It reads as the [`Scene`] that it holds; [`Scene::check`] makes it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(into = "Scene", try_from = "Scene")]
pub struct CheckedScene(Arc<Lowered>);

/// What the clones of a checked scene share: the scene, and its phases from when they are first asked for.
#[derive(Debug, Clone)]
struct Lowered {
    scene: Scene,
    /// The phases of a scene that differs in its drive alone.
    known: Option<Arc<Phases>>,
    phases: OnceLock<Arc<Phases>>,
}

impl Scene {
    /// Makes a [`CheckedScene`] of this scene if every parameter is in its range.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    pub fn check(&self) -> Result<CheckedScene, SceneError> {
        self.clone().try_into()
    }
}

impl TryFrom<Scene> for CheckedScene {
    type Error = SceneError;

    fn try_from(scene: Scene) -> Result<Self, SceneError> {
        scene.validate()?;
        Ok(Self::of_valid(scene, None))
    }
}

impl From<CheckedScene> for Scene {
    fn from(checked: CheckedScene) -> Self {
        Arc::unwrap_or_clone(checked.0).scene
    }
}

impl Deref for CheckedScene {
    type Target = Scene;

    #[inline]
    fn deref(&self) -> &Scene {
        &self.0.scene
    }
}

impl PartialEq for CheckedScene {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl CheckedScene {
    /// Makes a checked scene of one that is known to be valid; `like` is one that may differ from it in its drive
    /// alone, and then lends its phases.
    pub(crate) fn of_valid(mut scene: Scene, like: Option<&Self>) -> Self {
        let known = like.filter(|like| {
            let drive = replace(&mut scene.excitation, like.excitation);
            let has_same_laws = scene == ***like;
            scene.excitation = drive;
            has_same_laws
        });
        Self(Arc::new(Lowered {
            known: known.map(|like| like.phases().clone()),
            scene,
            phases: OnceLock::new(),
        }))
    }

    /// Checks another scene, and lowers it anew only where more than its drive differs from this one's.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    pub fn recheck(&self, scene: Scene) -> Result<Self, SceneError> {
        let checked = Self::of_valid(scene, Some(self));
        checked.validate_parameters(match checked.0.known {
            Some(_) => &Parameter::OF_DRIVE,
            None => &Parameter::ALL,
        })?;
        Ok(checked)
    }

    /// This checked scene with another drive angle in rad at time 0.
    ///
    /// # Errors
    /// [`SceneError::OutOfRange`] if the angle is not finite.
    pub fn at_phase(mut self, phase: f64) -> Result<Self, SceneError> {
        Parameter::Phase.check(phase)?;
        Arc::make_mut(&mut self.0).scene.excitation.phase = phase;
        Ok(self)
    }

    /// The phases of the scene.
    #[doc(hidden)]
    #[inline]
    pub fn phases(&self) -> &Arc<Phases> {
        self.0.phases.get_or_init(|| match &self.0.known {
            Some(known) => known.with_drive(&self.excitation).into(),
            None => Phases::of_scene(self).into(),
        })
    }
}
